"""The bits or lines that an encoder needs for a wanted resolution, and the bits that count its turns."""

from __future__ import annotations

from fractions import Fraction
from math import ceil
from typing import Self

from pydantic import model_validator

from derive.algebra.numbers.floats import scalar_number
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol, number
from derive.kinds.checks import route
from derive.kinds.fields import Angle, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import TURN
from derive.kinds.sensor._facts import SizeFacts as Facts
from derive.kinds.sensor._size_checks import as_told, enough
from derive.kinds.work import Work
from derive.mechanics.sensing import Encoder, Incremental

NEEDS = ("encoder",)
CLAIMS = ("enough", "as-told")


class Options(OptionsModel):
    """What the encoder has to tell apart."""

    resolution: Angle | None = None
    """The angle of the link that one count is at most."""
    range: Angle | None = None
    """The angle through which the link turns, where the turns of the motor are counted."""

    @model_validator(mode="after")
    def _one_at_least(self) -> Self:
        if self.resolution is None and self.range is None:
            raise ValueError("give resolution: 0.01 deg or range: 270 deg, or both")
        return self


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """The smallest whole number with 2^b >= 2 pi/(G Delta), with k N_l >= 2 pi/(G Delta), or with
    2^b_t >= G phi/(2 pi).

    Raises NotDerivable where these are no numbers, and for the turns of a disk that counts lines.
    """
    work, gear = Work(problem), None
    if encoder.gear is not None:
        work, (gear,) = work.naming(G=encoder.gear)
    pages, relations = dict[str, str](), list[tuple[str, Relation]]()
    disc = encoder.disc
    if options.resolution is not None:
        work, (finest,) = work.naming(Delta_max=options.resolution)
        work = work.worked("n", TURN / (gear * finest if gear else finest))
        if isinstance(disc, Incremental):
            work, (edges,) = work.naming(k=disc.edges)
            work = work.worked("n_l", Symbol("n") / edges)
            lines = ceil(_fraction(work, "n_l"))
            work = work.line("N_l", value=number(lines))
            relations.append(("N_l", Relation(number(lines), ">=", Symbol("n_l"))))
            pages["lines"] = "N_l"
        else:
            work, relation = _bits(work, "b", Symbol("n"))
            relations.append(("b", relation))
            pages["bits"] = "b"
    if options.range is not None:
        if isinstance(disc, Incremental):
            raise NotDerivable("an incremental encoder counts its turns by itself", "range")
        work, (through,) = work.naming(phi=options.range)
        work = work.worked("n_t", (gear * through if gear else through) / TURN)
        work, relation = _bits(work, "b_t", Symbol("n_t"))
        relations.append(("b_t", relation))
        pages["turn_bits"] = "b_t"
    results = {name: work.final(line) for name, line in pages.items()}
    facts = Facts(
        given=work.typed, gear=gear, found=tuple(relations), page_names=pages,
    )  # fmt: skip
    work = work.claim(route("enough", enough(encoder, options, results, problem)))
    work = work.claim(route("as-told", as_told(facts, work)))
    return work.answer("encoder-size", results, facts)


def _fraction(work: Work, name: str) -> Fraction:
    """The value of a line. Raises NotDerivable where it is none or not positive."""
    scalar = work.scalar(Symbol(name))
    try:  # a multiple of pi is no whole number, and floats tell between which it lies
        value = Fraction(scalar_number(scalar, {})) if scalar.constant is None else Fraction(scalar.constant)
    except KeyError:
        raise NotDerivable("how many there are is a whole number, which takes numbers") from None
    if value <= 0:
        raise NotDerivable("the angles must be positive")
    return value


def _bits(work: Work, name: str, wanted: Symbol) -> tuple[Work, Relation]:
    """The smallest number of bits, and between which powers the wanted number lies."""
    size = max(1, (ceil(_fraction(work, wanted.name)) - 1).bit_length())
    powers: list[Expr] = [number(2) ** number(size - 1), number(2) ** number(size)]
    work = work.line(name, value=number(size))
    if _fraction(work, wanted.name) <= 1:
        return work, Relation(wanted, "<=", powers[1])
    return work, Relation(Relation(powers[0], "<", wanted), "<=", powers[1])
