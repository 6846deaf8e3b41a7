"""What is said of the stiffness before the states of rest are listed: which of them it makes stable."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Record
from derive.expression import Expr, Symbol
from derive.kinds.lagrange._model import Model
from derive.kinds.lagrange._stiffness import is_gyroscopic
from derive.mechanics.lagrangian import without


class Criterion(Record):
    one: bool  # coordinate
    effective: Expr | None  # potential energy: less what is left at rest of the kinetic energy, if any is
    falls: bool  # that energy, along some displacement, which is why a state is unstable
    neutral: tuple[Symbol, ...]  # coordinates that do not occur
    edge: bool  # parameters decide, and leave a case between


def criterion(model: Model, verdicts: Sequence[Phrase]) -> Criterion:
    """Lagrange and Dirichlet (Goldstein et al., Classical Mechanics, section 6.1)."""
    phrases = [part for said in verdicts for part in _parts(said)]
    keys = {each.key for each in phrases}
    falls = keys & {"unstable", "either-or", "either-or-negative"}
    return Criterion(
        one=len(model.system.coordinates) == 1,
        effective=_effective(model),
        falls=bool(falls) and not is_gyroscopic(model),
        neutral=tuple(dict.fromkeys(q for each in phrases if each.key == "neutral" for q in _along(each))),
        edge=bool(keys & {"either-or", "either-or-negative", "it-is-if"}),
    )


def _effective(model: Model) -> Expr | None:
    """P less the part of T that has no rates."""
    if not without(sum(model.kinetic, Scalar.of(0)), model.system.rates):
        return None
    return model.problem.readable(-without(model.lagrangian, model.system.rates))


def _parts(said: Phrase) -> Iterator[Phrase]:
    """A verdict, and those inside of it."""
    yield said
    for inner in said.about.values():
        if isinstance(inner, Phrase):
            yield from _parts(inner)


def _along(said: Phrase) -> Iterator[Symbol]:
    along = said.about["along"]
    yield from (each for each in along if isinstance(each, Symbol)) if isinstance(along, tuple) else ()
