"""Which equation computes which signal, so that every block of a diagram can be built.

A block must be proper. Where an equation asks for the derivative of a signal, it is taken from before the
integrator that the signal comes out of.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import TypeAlias

from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.control.linear import cleared, one_side
from derive.control.rational import Polynomial
from derive.control.signals import signals, unknowns
from derive.control.system import System
from derive.expression import Symbol, is_negative

Row: TypeAlias = Mapping[Symbol, Polynomial]  # signal -> its coefficient, left - right, no s below
MOST = 200  # ways to share out the equations that are looked at


@dataclass(frozen=True, slots=True)
class Branch:
    """What one signal adds: num / den of its derivative of order `tap`."""

    signal: Symbol
    tap: int
    num: Polynomial


@dataclass(frozen=True, slots=True)
class Realised:
    """signal = (sum of branch.num * branch) / den, integrated `integrators` times."""

    signal: Symbol
    equation: int
    branches: tuple[Branch, ...]
    den: Polynomial
    integrators: int


def realisations(system: System, style: Style) -> Iterator[tuple[Realised, ...]]:
    """Every way to compute each unknown signal by an equation of its own, equations typed solved first."""
    found = signals(system)
    rows = [cleared(one_side(equation, found, style)) for equation in system.equations]
    shares = islice(_shares(rows, unknowns(system, found), {}), MOST)
    for share in sorted(shares, key=lambda each: _rewritten(system, each)):
        tails = {signal: _zeros(rows[place][signal]) for signal, place in share.items()}
        by_equation = sorted(share.items(), key=lambda item: item[1])
        done = [_realised(rows[place], signal, place, tails) for signal, place in by_equation]
        if all(each is not None for each in done):
            yield tuple(each for each in done if each is not None)


def _shares(
    rows: Sequence[Row], left: tuple[Symbol, ...], taken: dict[Symbol, int]
) -> Iterator[dict[Symbol, int]]:
    """Signals matched with equations that hold them."""
    if not left:
        yield taken
        return
    free = [place for place in range(len(rows)) if place not in taken.values()]
    able = {signal: [place for place in free if signal in rows[place]] for signal in left}
    signal = min(left, key=lambda each: len(able[each]))
    rest = tuple(each for each in left if each != signal)
    for place in able[signal]:
        yield from _shares(rows, rest, {**taken, signal: place})


def _rewritten(system: System, share: Mapping[Symbol, int]) -> int:
    """How many equations have to be solved for their signal first."""
    pairs = ((signal, system.equations[place]) for signal, place in share.items())
    return sum(signal not in (equation.left, equation.right) for signal, equation in pairs)


def _realised(row: Row, signal: Symbol, place: int, tails: Mapping[Symbol, int]) -> Realised | None:
    """None where a branch would be improper."""
    own, tail = row[signal], tails[signal]
    den = own[: len(own) - tail]
    branches = [_branch(each, row[each], tails.get(each, 0)) for each in row if each != signal]
    if any(len(branch.num) > len(den) for branch in branches):
        return None
    scale = Scalar.of(-1 if is_negative(readable(den[0])) else 1) if len(den) > 1 else den[0]
    branches = [Branch(b.signal, b.tap, tuple(c / scale for c in b.num)) for b in branches]
    return Realised(signal, place, tuple(branches), tuple(c / scale for c in den), tail)


def _branch(signal: Symbol, coefficient: Polynomial, tail: int) -> Branch:
    tap = min(_zeros(coefficient), tail)
    kept = coefficient[: len(coefficient) - tap]
    return Branch(signal, tap, tuple(-c for c in kept))


def _zeros(coefficients: Polynomial) -> int:
    """How often s divides it."""
    return next(k for k, c in enumerate(reversed(coefficients)) if c)
