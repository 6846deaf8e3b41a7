"""The second route: the equations as typed, solved in complex numbers, against what was derived."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping

from derive.algebra.numbers.floats import scalar_number
from derive.control.controllers import Controller
from derive.control.laplace import Numeric, is_close, quotient
from derive.control.rational import Rational
from derive.control.signals import signals
from derive.control.system import System
from derive.derivation import Claim
from derive.expression import Symbol, free_symbols
from derive.kinds.checks import SECOND_ROUTE, random_points

POINTS = 3


def agrees(
    key: str, system: System, source: Symbol, rational: Rational, controller: Controller | None = None
) -> Claim:
    """A transfer function against the equations (with the loop closed, if there is a controller) at random
    values of the parameters and of s."""
    names = _parameters(system, controller)
    holds = all(
        _at(system, source, rational, controller, at, complex(at.pop("s"), 1.0 + k))
        for k, at in enumerate(random_points([*names, "s"], POINTS))
    )
    return Claim(key, SECOND_ROUTE, holds)


def _at(
    system: System,
    source: Symbol,
    rational: Rational,
    controller: Controller | None,
    point: Mapping[str, float],
    s: complex,
) -> bool:
    num = [scalar_number(c, point) if c else 0.0 for c in rational.num]
    den = [scalar_number(c, point) if c else 0.0 for c in rational.den]
    solved = Numeric.of(system, source, point)
    other = solved.gain(s) if controller is None else solved.closed(s, controller.sum)
    ours = quotient(num, den, s)
    return is_close(ours, other) and math.isfinite(abs(ours)) and not cmath.isnan(other)


def _parameters(system: System, controller: Controller | None) -> list[str]:
    trees = [side for equation in system.equations for side in (equation.left, equation.right)]
    trees += [] if controller is None else [controller.sum]
    known = {signal.name for signal in signals(system)} | {"s"}
    return sorted({name for tree in trees for name in free_symbols(tree)} - known)
