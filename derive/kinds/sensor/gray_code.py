"""A position of an absolute encoder in binary digits and in the Gray code of its disk, or read from that."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BeforeValidator, Field, model_validator

from derive.algebra.formulas.quantities import rational
from derive.derivation import Cell, Derivation, PageFacts, Phrase, Table
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, add, column, number
from derive.kinds.checks import route
from derive.kinds.fields import OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.sensor._encoder import DELTA, UNITS
from derive.kinds.sensor._gray_checks import as_told, reflected
from derive.kinds.work import Work
from derive.mechanics.sensing import Absolute, Encoder

NEEDS = ("absolute", "size")
USES = frozenset({"bits"})
CLAIMS = ("reflected", "as-told")
CLAIMED = dict.fromkeys(("binary", "gray"), "reflected")
MOST_BITS = 32
LYING = 12  # digits that stand beside each other


def _code(typed: object) -> object:
    if typed is not None and not {*str(typed)} <= {*"01"}:
        raise ValueError('a code has the digits 0 and 1; write it in quotes, as "0110"')
    return None if typed is None else str(typed)


Code = Annotated[str, BeforeValidator(_code)]


class Options(OptionsModel):
    """A position, or its code."""

    position: Annotated[int, Field(ge=0)] | None = None
    """The position that is to be coded, from 0."""
    code: Code | None = None
    """The code that is read, in quotes, as "0110"."""

    @model_validator(mode="after")
    def _one_of_them(self) -> Self:
        if (self.position is None) == (self.code is None):
            raise ValueError('give either position: 11 or code: "1110"')
        return self


class Facts(PageFacts):
    bits: Expr
    read: bool  # from the code
    table: Table
    position: Symbol
    angle: Symbol  # of the link


def derive(encoder: Encoder, options: Options, problem: Problem) -> Derivation:
    """g_k = b_k xor b_(k+1), and back from the first digit on (Siciliano et al., section 5.3.1).

    Raises NotDerivable where the bits are no number or too many, and for a position the disk does not have.
    """
    bits = _size(encoder, problem)
    p = options.position if options.position is not None else _position(options.code or "", bits)
    if p >= 2**bits:
        raise NotDerivable(f"{bits} bits tell the positions 0 to {2**bits - 1} apart", "position")
    binary = [p >> k & 1 for k in reversed(range(bits))]
    gray = [b ^ before for b, before in zip(binary, [0, *binary], strict=False)]
    base = problem.ask("resolution")
    work = Work(problem, angular=True, units=UNITS, taken=problem.symbols & {"p", "alpha"}).resting_on(base)
    powers = [number(2) ** number(bits - 1 - k) for k, digit in enumerate(binary) if digit]
    work = work.line("p", value=number(p)) if not p else work.worked("p", add(*powers), number(p))
    work = work.worked("alpha", work.symbol("p") * DELTA)
    results: dict[str, Expr | Matrix] = {
        "binary": column(map(number, binary)),
        "gray": column(map(number, gray)),
        "position": work.final("p"),
        "angle": work.final("alpha"),
    }
    facts = Facts(
        bits=number(bits), read=options.code is not None, table=_table(binary, gray),
        position=work.symbol("p"), angle=work.symbol("alpha"),
        page_names={"position": work.symbol("p").name, "angle": work.symbol("alpha").name},
    )  # fmt: skip
    work = work.claim(route("reflected", reflected(results, bits, options.code)))
    work = work.claim(route("as-told", as_told(facts.table, results, bits)))
    return work.answer("gray-code", results, facts, units={**UNITS, work.symbol("alpha"): "deg"})


def _size(encoder: Encoder, problem: Problem) -> int:
    bits = rational(problem.final(encoder.disc.bits)) if isinstance(encoder.disc, Absolute) else None
    if bits is None:
        raise NotDerivable("digits are told of an encoder whose bits are a number")
    if bits > MOST_BITS:
        raise NotDerivable(f"{bits} digits are more than a page shows (at most {MOST_BITS})")
    return int(bits)


def _position(code: str, bits: int) -> int:
    """Each binary digit is that of the code, turned over where the binary digit before it is 1."""
    if len(code) != bits:
        raise NotDerivable(f"the code has {len(code)} digits, and the encoder {bits} bits", "code")
    p = 0
    for digit in code:
        p = 2 * p + (int(digit) ^ p % 2)
    return p


def _table(binary: list[int], gray: list[int]) -> Table:
    """The digits beside each other, or below each other where there are many."""
    n = len(binary)
    places: list[Expr] = [number(n - 1 - k) for k in range(n)]
    rows: list[tuple[Cell, ...]] = [
        (Phrase("binary"), *map(number, binary)),
        (Phrase("gray"), *map(number, gray)),
    ]
    if n <= LYING:
        return Table((Phrase("place"), *places), tuple(rows))
    columns = tuple(zip(places, *(row[1:] for row in rows), strict=True))
    return Table((Phrase("place"), Phrase("binary"), Phrase("gray")), columns)
