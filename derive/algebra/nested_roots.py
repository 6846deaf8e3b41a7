"""Whether a polynomial in roots of numbers is zero, roots of sums of roots among them.

sqrt(3 + 2 sqrt(2)) is a generator of its own, though it is 1 + sqrt(2). With r^2 = u the polynomial is
a + b r. Where it is zero, so is a^2 - b^2 u, which no longer holds r; and where that is zero, one of a + b r
and a - b r is, for numbers with symbols beside them form an integral domain: their values say which. That
is not so of roots of symbols: x^2 - |x|^2 is zero, and neither of x + |x| and x - |x| is.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from flint import fmpq, fmpq_mpoly

from derive.algebra.angles import PI, RADIAN
from derive.algebra.ring import Ring

Reduce = Callable[[fmpq_mpoly], fmpq_mpoly]


def cancels(polynomial: fmpq_mpoly, home: Ring, reduce: Reduce) -> bool:
    """Whether a polynomial reduced as far as the ring knows is zero all the same."""
    if polynomial == 0:
        return True
    degrees = polynomial.degrees()
    used = [i for i in range(len(home.roots)) if degrees[i] > 0]
    nested = (i for i in used if len(home.roots[i].radicand) > 1 and home.roots[i].degree == 2)
    found = next(nested, None)
    if found is None or not all(is_number(home.roots[i].name, home) for i in used):
        return False
    r = home.gen(home.roots[found].name)
    b = polynomial.derivative(found)
    a = polynomial - b * r
    norm = reduce(a * a - b * b * home.polynomial(home.roots[found].radicand))
    return cancels(norm, home, reduce) and abs(value_of(a + b * r, home)) <= abs(value_of(a - b * r, home))


def is_number(name: str, home: Ring) -> bool:
    """Whether a generator is a root of numbers or of a fixed angle; the root of one number comes last."""
    for root in home.roots:
        if root.name == name:
            return all(is_number(inner, home) for powers, _ in root.radicand for inner, _ in powers)
    return any(
        name in (f"cos({form})", f"sin({form})") and {atom for atom, _ in form.parts} <= {PI, RADIAN}
        for form in home.angles
    )


def value_of(polynomial: fmpq_mpoly, home: Ring) -> float:
    """Its value where each symbol and angle has some value."""
    gens: dict[str, float] = {name: 0.3 + math.sqrt(i + 2) % 1 for i, name in enumerate(home.symbols)}
    for k, form in enumerate(home.angles):
        at = sum(float(n) * {PI: math.pi, RADIAN: 1.0}.get(atom, 0.7 + k) for atom, n in form.parts)
        gens |= {f"cos({form})": math.cos(at), f"sin({form})": math.sin(at)}
    for root in reversed(home.roots):
        inside = math.fsum(
            float(k) * math.prod(gens[name] ** power for name, power in powers) for powers, k in root.radicand
        )
        gens[root.name] = max(inside, 0.0) ** (1 / root.degree)
    value = polynomial(*(fmpq(*gens[name].as_integer_ratio()) for name in home.names))
    return int(value.p) / int(value.q)
