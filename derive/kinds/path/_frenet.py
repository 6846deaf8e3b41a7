"""Tangent, normal, binormal and curvature of a path (Siciliano et al., section 4.3.1; do Carmo, Differential
Geometry of Curves and Surfaces, section 1.5)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction

from derive.expression import Call, Derivative, Expr, Matrix, Symbol, cross, number, symbols
from derive.kinds.path._shapes import QUARTER, Along
from derive.kinds.path._sizes import settled, slope, told
from derive.kinds.work import Work
from derive.names import free

KAPPA, E_T, E_N, E_B = symbols("kappa e_t e_n e_b")


@dataclass(frozen=True, slots=True)
class Bent:
    """A path with its derivatives by the parameter and its Frenet frame on the board."""

    work: Work
    along: Along
    first: Symbol  # dp/ds
    second: Symbol
    speed: Symbol  # |dp/ds|
    steady: bool  # whether the speed is constant
    straight: bool
    flat: bool  # in the plane
    across: Symbol  # the vector product of both derivatives, in space

    @property
    def unit(self) -> bool:
        """Whether the parameter is the arc length."""
        return self.work.value(self.speed) == 1

    @property
    def frame(self) -> tuple[Symbol, ...]:
        """Its unit vectors, as far as there are such."""
        if self.straight:
            return (E_T,)
        return (E_T, E_N) if self.flat else (E_T, E_N, E_B)


def abs_of(expr: Expr) -> Call:
    """The size of a number or a vector."""
    return Call("abs", (expr,))


def differentiated(along: Along) -> Bent:
    """The derivatives by the parameter, without the frame."""
    p, s = along.p, along.s
    first, second = Symbol(f"{p.name}_{s.name}"), Symbol(f"{p.name}_{s.name}{s.name}")
    speed = Symbol(f"sigma_{s.name}")
    work = along.work.line(first, Derivative(p, s), value=slope(along.work, p, s))
    work = work.line(second, Derivative(first, s), value=slope(work, first, s))
    work = told(work, speed, abs_of(first))
    steady = not work.value(speed).diff(s.name)
    flat = work.matrix(p).shape[0] == 2
    across = Symbol(free(along.work.problem.taken, "c", "w", "d"))
    return Bent(work, along, first, second, speed, steady, False, flat, across)


def bent(along: Along) -> Bent:
    """The derivatives, then the frame."""
    found = differentiated(along)
    work = told(found.work, E_T, found.first / found.speed)
    found = replace(found, work=work)
    return _steadily(found) if found.steady else _in_the_plane(found) if found.flat else _in_space(found)


def _steadily(found: Bent) -> Bent:
    """The speed is constant, so the second derivative is perpendicular to the path."""
    work, second, speed = found.work, found.second, found.speed
    size = abs_of(second)
    work = told(work, KAPPA, size if found.unit else size / speed**2)
    if not work.value(KAPPA):
        return replace(found, work=work, straight=True)
    work = told(work, E_N, second / size)
    if not found.flat:
        work = told(work, E_B, cross(E_T, E_N))
    return replace(found, work=work)


def _in_the_plane(found: Bent) -> Bent:
    """By the area that both derivatives span, which has a sign."""
    work, speed = found.work, found.speed
    area = Call("det", (Matrix(((found.first, found.second),)),))
    work = _curved(work, abs_of(area), speed)
    if not work.value(KAPPA):
        return replace(found, work=work, straight=True)
    work = told(work, E_N, area / abs_of(area) * QUARTER * E_T)
    return replace(found, work=work)


def _in_space(found: Bent) -> Bent:
    """By the vector product of both derivatives."""
    c, speed = found.across, found.speed
    work = found.work.line(c, cross(found.first, found.second))
    work = _curved(work, abs_of(c), speed)
    if not work.value(c):
        return replace(found, work=work, straight=True)
    work = told(work, E_B, c / abs_of(c))
    return replace(found, work=told(work, E_N, cross(E_B, E_T)))


def _curved(work: Work, size: Expr, speed: Symbol) -> Work:
    """The curvature by the size of what both derivatives span; over q^(3/2) where the speed is sqrt(q)."""
    formula = size / speed**3
    match work[speed]:
        case Call("sqrt", (inside,)) if work.value(formula):
            above = work.readable(settled(work.value(size), work.problem))
            return told(work, KAPPA, formula, above / inside ** number(Fraction(3, 2)))
    return told(work, KAPPA, formula)
