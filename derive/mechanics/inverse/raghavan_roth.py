"""All poses of six revolute joints by the elimination of Raghavan and Roth (1993), in exact numbers.

The loop Rz(q_1) C_1 ... Rz(q_6) C_6 = 1 is cut: what comes from q_3, q_4, q_5 equals what comes from the
others. Along the axis of q_6 nothing changes with q_6: its direction l and a point p of it give the six
equations l and p, and with p.p, p.l, p x l and (p.p) l - 2 (p.l) p fourteen, all of which hold cosine and
sine of q_1 and q_2 in the same eight products, and of q_4 and q_5 in nine. Without the eight there are
six; in x = tan(q/2) of q_4 and q_5, and once more times x_4, twelve in twelve powers, whose determinant is
(1 + x_3^2)^4 times a polynomial of the sixteenth degree.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import TYPE_CHECKING, Any

from flint import fmpq, fmpq_mat, fmpq_poly

from derive.mechanics.inverse.closed_loop import Loop, inverse, turned

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

EQUATIONS, EIGHT, TWELVE, DEGREE = 14, 8, 12, 16
CIRCLE = ((1, 0), (-1, 0), (0, 1))  # cosine and sine where a function of 1, cosine and sine is looked at
HALF_ANGLE = ((1, 0, 1), (1, 0, -1), (0, 2, 0))  # 1, cosine and sine by powers of x, times 1 + x^2
ZERO, ONE = fmpq(0), fmpq(1)
AT = ((fmpq(3, 5), fmpq(4, 5)), (fmpq(-5, 13), fmpq(12, 13)))  # cosine and sine of some angles
GOOD = 1e-3  # of singular values
LEAST = 1e-9  # below which a number is zero but for rounding
Vector = list[fmpq]
Values = dict[tuple[int, ...], Vector]
THREE = range(3)


@dataclass(frozen=True)
class Elimination:
    """What is left of a loop without its first, second and last angle: `left` (6 by 27) holds the products
    of 1, cosine and sine of the third, fourth and fifth. `eight` (14 by 8) and `nine` (14 by 27) are the
    fourteen equations, eight products on the one side and the twenty-seven on the other."""

    loop: Loop
    left: fmpq_mat
    eight: fmpq_mat
    nine: fmpq_mat
    powers: tuple[int, int] = (4, 3)  # of x_4 and x_5: one of them is multiplied with once more

    @property
    def unknown(self) -> str:
        """The joint that the polynomial is in."""
        return self.loop.joints[2]

    def matrix(self, c: fmpq, s: fmpq) -> fmpq_mat:
        """12 by 12, at a third angle: by powers x_4^i x_5^j, with i and j below `powers`."""
        rows = []
        for n in range(self.left.nrows()):
            here = [[self._at(n, j, k, c, s) for k in THREE] for j in THREE]
            powers = [
                sum(
                    (HALF_ANGLE[j][a] * HALF_ANGLE[k][b] * here[j][k] for j, k in product(THREE, THREE)), ZERO
                )
                for a, b in product(THREE, THREE)
            ]
            rows += [self._placed(powers, 0, 0), self._placed(powers, self.powers[0] - 3, self.powers[1] - 3)]
        return fmpq_mat(rows)

    def _placed(self, powers: Vector, more: int, also: int) -> Vector:
        """Nine coefficients among the twelve, by so many powers higher."""
        found = [ZERO] * TWELVE
        for (a, b), each in zip(product(THREE, THREE), powers, strict=True):
            found[self.powers[1] * (a + more) + b + also] = each
        return found

    def _at(self, n: int, j: int, k: int, c: fmpq, s: fmpq) -> fmpq:
        one, by_c, by_s = (self.left[n, 9 * i + 3 * j + k] for i in THREE)
        return one + by_c * c + by_s * s

    @cached_property
    def condition(self) -> float:
        """The smallest singular value of the matrix against the largest, at some angles: zero where its
        determinant vanishes for every one."""
        import numpy as np

        sizes = [np.linalg.svd(floats(self.matrix(*at)), compute_uv=False) for at in AT]
        return max(float(each[-1] / each[0]) for each in sizes)

    @cached_property
    def polynomial(self) -> fmpq_poly:
        """Of degree 16 at most, in x = tan(q/2), every factor once. Raises ArithmeticError where it is
        none."""
        places = [fmpq(k, 5) for k in range(-DEGREE // 2, DEGREE // 2 + 2)]
        values = [self._value(x) for x in places]
        found = _interpolated(places[:-1], values[:-1])
        if found(places[-1]) != values[-1]:
            raise ArithmeticError("the determinant has another degree")
        return found // found.gcd(found.derivative())

    @property
    def is_whole(self) -> bool:
        """Whether it has its full degree: then no two solutions share an angle but by chance."""
        return int(self.polynomial.degree()) == DEGREE

    def _value(self, x: fmpq) -> fmpq:
        """The determinant times (1 + x^2)^12, by (1 + x^2)^4."""
        ones = ONE + x * x
        return self.matrix((ONE - x * x) / ones, 2 * x / ones).det() * ones**8


def eliminations(loop: Loop) -> Iterator[Elimination]:
    """With the loop begun at each joint, in both directions: those that do not vanish, the
    well-conditioned ones as they come, then the others, the best first."""
    both = (loop, loop.backwards())
    found = (_eliminated(each.beginning(k)) for each in both for k in range(len(loop.joints)))
    others = []
    for each in (each for one in found if one for each in (one, replace(one, powers=(3, 4)))):
        if each.condition > GOOD:
            yield each
        elif each.condition > LEAST:
            others.append(each)
    yield from sorted(others, key=lambda each: each.condition, reverse=True)


def _eliminated(loop: Loop) -> Elimination | None:
    """None where the eight products cannot be eliminated one by one."""
    nine, several = _from_three(loop), _from_two(loop)
    constant, *others = several
    eight = fmpq_mat([[each[e] for each in others] for e in range(EQUATIONS)])
    nine = [
        [each - constant[e] if not m else each for m, each in enumerate(row)] for e, row in enumerate(nine)
    ]
    solved = _independent(floats(eight))
    if len(solved) < EIGHT:
        return None
    rest = [e for e in range(EQUATIONS) if e not in solved]
    rows = eight.tolist()
    by = fmpq_mat([rows[e] for e in rest]) * fmpq_mat([rows[e] for e in solved]).inv()
    left = fmpq_mat([nine[e] for e in rest]) - by * fmpq_mat([nine[e] for e in solved])
    return Elimination(loop, left, eight, fmpq_mat(nine))


def _independent(rows: Array) -> list[int]:
    """As many rows as are independent, each time the one that is longest without those before."""
    import numpy as np

    left = rows / np.abs(rows).max()
    found: list[int] = []
    while len(found) < EIGHT:
        sizes = np.linalg.norm(left, axis=1)
        best = int(sizes.argmax())
        if sizes[best] < LEAST:
            break
        found.append(best)
        along = left[best] / sizes[best]
        left = left - np.outer(left @ along, along)
    return found


def floats(matrix: fmpq_mat) -> Array:
    """In floating point."""
    import numpy as np

    return np.array([[int(each.p) / int(each.q) for each in row] for row in matrix.tolist()])


def _from_three(loop: Loop) -> list[Vector]:
    """The fourteen in the third, fourth and fifth angle: 14 by 27."""
    _, _, C_3, C_4, C_5, _ = loop.after
    turns = [turned(fmpq(c), fmpq(s)) for c, s in CIRCLE]
    values: Values = {
        (i, j, k): fourteen(turns[i] * C_3 * turns[j] * C_4 * turns[k] * C_5)
        for i, j, k in product(THREE, THREE, THREE)
    }
    for axis in THREE:
        values = _along(values, axis)
    return [[values[place][e] for place in product(THREE, THREE, THREE)] for e in range(EQUATIONS)]


def _from_two(loop: Loop) -> list[Vector]:
    """The fourteen in the first and second angle, for each of nine products."""
    C_1, C_2, *_, C_6 = loop.after
    back = [turned(fmpq(c), fmpq(-s)) for c, s in CIRCLE]
    values: Values = {
        (i, j): fourteen(inverse(C_2) * back[j] * inverse(C_1) * back[i] * inverse(C_6))
        for i, j in product(THREE, THREE)
    }
    for axis in (0, 1):
        values = _along(values, axis)
    return [values[place] for place in product(THREE, THREE)]


def _along(values: Values, axis: int) -> Values:
    """By 1, cosine and sine of one angle, from the values at its places on the circle."""
    found = {}
    for place in values:
        if place[axis] == 0:
            ahead, behind, aside = (values[(*place[:axis], k, *place[axis + 1 :])] for k in THREE)
            one = [(a + b) / 2 for a, b in zip(ahead, behind, strict=True)]
            cosine = [(a - b) / 2 for a, b in zip(ahead, behind, strict=True)]
            sine = [a - b for a, b in zip(aside, one, strict=True)]
            for k, each in enumerate((one, cosine, sine)):
                found[*place[:axis], k, *place[axis + 1 :]] = each
    return found


def fourteen(T: fmpq_mat) -> Vector:
    """l, p, p.p, p.l, p x l and (p.p) l - 2 (p.l) p of the z-axis of a frame."""
    z, p = ([T[i, column] for i in THREE] for column in (2, 3))
    pp, pl = _dot(p, p), _dot(p, z)
    cross = [p[1] * z[2] - p[2] * z[1], p[2] * z[0] - p[0] * z[2], p[0] * z[1] - p[1] * z[0]]
    return [*z, *p, pp, pl, *cross, *(pp * a - 2 * pl * b for a, b in zip(z, p, strict=True))]


def _dot(one: Sequence[fmpq], other: Sequence[fmpq]) -> fmpq:
    return sum((a * b for a, b in zip(one, other, strict=True)), ZERO)


def _interpolated(places: Sequence[fmpq], values: Sequence[fmpq]) -> fmpq_poly:
    """By divided differences (Newton)."""
    differences = list(values)
    for order in range(1, len(places)):
        for k in range(len(places) - 1, order - 1, -1):
            differences[k] = (differences[k] - differences[k - 1]) / (places[k] - places[k - order])
    found = fmpq_poly([differences[-1]])
    for k in range(len(places) - 2, -1, -1):
        found = found * fmpq_poly([-places[k], 1]) + differences[k]
    return found
