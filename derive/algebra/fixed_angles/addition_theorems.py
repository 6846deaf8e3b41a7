"""Fixed angles that are sums of others beside them, written out: cos 61 deg where 25 and 36 deg stand too.

A page says cos 61 deg for what was computed as the product of turns by 25 and 36 deg; so the two differ by an
addition theorem, and this is the short way of seeing it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import combinations, product
from math import lcm
from typing import TypeAlias

from flint import fmpq_mpoly

from derive.algebra.angles import Form
from derive.algebra.generators import PI
from derive.algebra.ring import Pair, Ring, ring

Sum: TypeAlias = tuple[int, tuple[tuple[Form, int], ...]]  # steps of 15 degrees, and angles with their signs
Key: TypeAlias = tuple[int, ...]
Images: TypeAlias = tuple[fmpq_mpoly, ...]

ROOTS = ("sqrt(2)", "sqrt(3)")


def independent(polynomial: fmpq_mpoly, home: Ring) -> tuple[fmpq_mpoly, Ring]:
    """The polynomial, reduced, in a ring whose fixed angles are no short sums of each other."""
    target, images = _independent(home)
    if target is home:
        return polynomial, home
    return target.reduce(polynomial.compose(*images, ctx=target.context)), target


@lru_cache(maxsize=1024)
def _independent(home: Ring) -> tuple[Ring, Images]:
    """The ring, and where the generators of `home` go there."""
    step = _step({root.name for root in home.roots})
    kept: list[Form] = []
    sums: dict[Form, Sum] = {}
    for form in home.angles:
        if not form.moving.parts:
            found = _sum(form, kept, step)
            if found is None:
                kept.append(form)
            else:
                sums[form] = found
    if not sums:
        return home, ()
    target = ring((), tuple(form for form in home.angles if form not in sums), home.symbols)
    same: dict[str, str] = {}
    inner_first = home.roots[::-1]
    for root in sorted(inner_first, key=lambda root: root.name not in ROOTS):
        images = _images(home, sums, same, target)
        inside = target.reduce(home.polynomial(root.radicand).compose(*images, ctx=target.context))
        moved = replace(root, radicand=target.terms(inside))
        known = (each for each in target.roots if replace(each, name=root.name) == moved)
        same[root.name] = next((each.name for each in known), root.name)
        target = target if same[root.name] in target.index else target.with_root(moved)
    return target, _images(home, sums, same, target)


def _images(home: Ring, sums: dict[Form, Sum], same: Mapping[str, str], target: Ring) -> Images:
    """Roots of the same go to the `same` one; zero for those that have no place yet."""
    pairs = [_pair(form, sums, target) for form in home.angles]
    roots = (same.get(root.name) for root in home.roots)
    return (
        *(target.zero if name is None else target.gen(name) for name in roots),
        *(sine for _, sine in pairs),
        *(cosine for cosine, _ in pairs),
        *map(target.gen, home.symbols),
    )


def _step(roots: Collection[str]) -> int:
    """Of how many times 15 degrees all multiples have their sines over these roots."""
    two, three = (root in roots for root in ROOTS)
    return 1 if two and three else 2 if three else 3 if two else 6


def _sum(form: Form, others: Sequence[Form], step: int) -> Sum | None:
    """How an angle is made of such steps and up to four of the others, or twice one of them."""
    atoms = sorted({atom for each in (form, *others) for atom, _ in each.parts} | {PI})
    scale = lcm(12, *(n.denominator for each in (form, *others) for _, n in each.parts))

    def key(signed: Sequence[tuple[Form, int]]) -> Key:
        """Up to steps."""
        at = [sum(n * int(each.of_atom(atom) * scale) for each, n in signed) for atom in atoms]
        return tuple(n % (scale // 12 * step) if atom == PI else n for atom, n in zip(atoms, at, strict=True))

    singles = [((other, n),) for other in others for n in (1, -1, 2, -2)]
    pairs = [((a, m), (b, n)) for a, b in combinations(others, 2) for m, n in product((1, -1), repeat=2)]
    short = {key(signed): signed for signed in (*pairs, *singles, ())}
    for first in short.values():
        rest = key(((form, 1), *((other, -n) for other, n in first)))
        if rest in short:
            signed = (*first, *short[rest])
            left = form.of_atom(PI) - sum(n * other.of_atom(PI) for other, n in signed)
            return int(12 * left) % 24, signed
    return None


def _pair(form: Form, sums: dict[Form, Sum], target: Ring) -> Pair:
    if form not in sums:
        return target.pair(target.angles.index(form))
    steps, signed = sums[form]
    c, s = _turned(steps, target)
    for other, n in signed:
        cosine, sine = target.pair(target.angles.index(other))
        sine = sine if n > 0 else -sine
        for _ in range(abs(n)):
            c, s = target.reduce(c * cosine - s * sine), target.reduce(s * cosine + c * sine)
    return c, s


def _turned(steps: int, home: Ring) -> Pair:
    """(cosine, sine) of so many steps of 15 degrees; of roots that have no place yet, zero."""
    one, zero = home.one, home.zero
    two, three = (home.gen(root) if root in home.index else zero for root in ROOTS)
    quarters, rest = divmod(steps, 6)
    high, low = two * (three + 1) / 4, two * (three - 1) / 4
    c, s = (
        (one, zero), (high, low), (three / 2, one / 2), (two / 2, two / 2), (one / 2, three / 2), (low, high),
    )[rest]  # fmt: skip
    return ((c, s), (-s, c), (-c, -s), (s, -c))[quarters]
