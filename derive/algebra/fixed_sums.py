"""Fixed angles that are sums of others beside them, written out: cos 61 deg where 25 and 36 deg stand too.

A page says cos 61 deg for what was computed as the product of turns by 25 and 36 deg; so the two differ by an
addition theorem, and this is the short way of seeing it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import combinations, product
from math import lcm
from typing import TypeAlias

from flint import fmpq_mpoly

from derive.algebra.angles import PI, Form
from derive.algebra.ring import Pair, Ring, ring

Sum: TypeAlias = tuple[int, tuple[tuple[Form, int], ...]]  # quarter turns, and angles with their signs
Key: TypeAlias = tuple[int, ...]
Images: TypeAlias = tuple[fmpq_mpoly, ...]


def independent(polynomial: fmpq_mpoly, home: Ring) -> tuple[fmpq_mpoly, Ring]:
    """The polynomial, reduced, in a ring whose fixed angles are no short sums of each other."""
    target, images = _independent(home)
    if target is home:
        return polynomial, home
    return target.reduce(polynomial.compose(*images, ctx=target.context)), target


@lru_cache(maxsize=1024)
def _independent(home: Ring) -> tuple[Ring, Images]:
    """The ring, and where the generators of `home` go there."""
    kept: list[Form] = []
    sums: dict[Form, Sum] = {}
    for form in home.angles:
        if not form.moving.parts:
            found = _sum(form, kept)
            if found is None:
                kept.append(form)
            else:
                sums[form] = found
    if not sums:
        return home, ()
    target = ring((), tuple(form for form in home.angles if form not in sums), home.symbols)
    same: dict[str, str] = {}
    for root in reversed(home.roots):
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


def _sum(form: Form, others: Sequence[Form]) -> Sum | None:
    """How an angle is made of quarter turns and up to four of the others, or twice one of them."""
    atoms = sorted({atom for each in (form, *others) for atom, _ in each.parts} | {PI})
    scale = 2 * lcm(*(n.denominator for each in (form, *others) for _, n in each.parts))

    def key(signed: Sequence[tuple[Form, int]]) -> Key:
        """Up to quarter turns."""
        at = [sum(n * int(each.of_atom(atom) * scale) for each, n in signed) for atom in atoms]
        return tuple(n % (scale // 2) if atom == PI else n for atom, n in zip(atoms, at, strict=True))

    singles = [((other, n),) for other in others for n in (1, -1, 2, -2)]
    pairs = [((a, m), (b, n)) for a, b in combinations(others, 2) for m, n in product((1, -1), repeat=2)]
    short = {key(signed): signed for signed in (*pairs, *singles, ())}
    for first in short.values():
        rest = key(((form, 1), *((other, -n) for other, n in first)))
        if rest in short:
            signed = (*first, *short[rest])
            left = form.of_atom(PI) - sum(n * other.of_atom(PI) for other, n in signed)
            return int(2 * left) % 4, signed
    return None


def _pair(form: Form, sums: dict[Form, Sum], target: Ring) -> Pair:
    if form not in sums:
        return target.pair(target.angles.index(form))
    quarters, signed = sums[form]
    one, zero = target.one, target.zero
    c, s = ((one, zero), (zero, one), (-one, zero), (zero, -one))[quarters]
    for other, n in signed:
        cosine, sine = target.pair(target.angles.index(other))
        sine = sine if n > 0 else -sine
        for _ in range(abs(n)):
            c, s = target.reduce(c * cosine - s * sine), target.reduce(s * cosine + c * sine)
    return c, s
