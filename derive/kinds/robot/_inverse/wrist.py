"""What a spherical wrist determines where its outer axes coincide: a sum or difference of two angles."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix, trig_of
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Said, Step
from derive.expression import Degrees, Expr, Matrix, Relation, Symbol, atan2, number
from derive.kinds.robot._inverse.facts import SingularWrist
from derive.kinds.robot._inverse.signs import signed


def singular(made: Matrix, known: Matrix, joints: tuple[str, ...], even: bool) -> Iterator[SingularWrist]:
    """`made` is the wrist's rotation in the angles of its three `joints`, `known` its entries by name; `even`
    where the middle angle is known by its cosine."""
    first, between, last = map(Symbol, joints)
    count = 0
    for degrees in (0, 180) if even else (90, -90):
        middle = Degrees(number(degrees).value)
        found = _combination(normal_matrix(made, {between: middle}), known, joints)
        if found:
            count += 1
            chain = (first + signed(found[0], last), found[1])
            about: dict[str, Said] = {"middle": Relation(between, "=", middle), "a": first, "b": last}
            said = Phrase("outer-axes-too" if count > 1 else "outer-axes", about)
            step = Step(f"singular_{count}", chain, "singular")
            yield SingularWrist(said=said, step=step)


def _combination(R: ScalarMatrix, known: Matrix, joints: tuple[str, ...]) -> tuple[int, Expr] | None:
    """The sum or difference of the outer angles that stands in R by its cosine and sine, with few signs."""
    first, last = Scalar.symbol(joints[0]), Scalar.symbol(joints[2])
    found = []
    for sign in (1, -1):
        c, s = trig_of(first + last * sign)
        for (sine, minuses), (cosine, more) in product(_entries(R, known, s), _entries(R, known, c)):
            found.append((minuses + more, sign, atan2(sine, cosine)))
    return min(found, key=lambda each: each[0])[1:] if found else None


def _entries(R: ScalarMatrix, known: Matrix, value: Scalar) -> Iterator[tuple[Expr, int]]:
    """The names of the entries that have this value, with their signs."""
    for i, j in product(range(3), repeat=2):
        if R[i, j] == value:
            yield known.rows[i][j], 0
        elif R[i, j] == -value:
            yield -known.rows[i][j], 1
