"""The joint variables on a path in closed form: those of a branch of the inverse kinematics, with their rates
and accelerations by the Jacobian."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import islice

from derive.algebra.numbers.compiled import Compiled, compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Branch, Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, column, replace, walk
from derive.kinds.path._moving import Moving
from derive.kinds.robot._carried.coordinates import Coordinates

LONG = 40_000  # nodes of a formula of the time alone
MANY = "the joint variables that follow this path are not determined by it; write method: inverse-velocity"


@dataclass(frozen=True)
class Followed:
    """Joint variables by the coordinates of the path (`q`, in turn), rates and accelerations by these."""

    branch: Branch
    variables: tuple[str, ...]
    where: Coordinates
    q: Mapping[str, Expr]
    qdot: Matrix
    qddot: Matrix
    by_time: tuple[Matrix, Matrix, Matrix]

    @property
    def given(self) -> dict[Expr, Expr]:
        """The coordinates, velocities and accelerations of the end-effector at a time."""
        names = (tuple(map(Symbol, self.where.names)), self.where.velocities, self.where.accelerations)
        trees = (entries(each) for each in self.by_time)
        return {
            name: tree
            for row, found in zip(names, trees, strict=True)
            for name, tree in zip(row, found, strict=True)
        }

    @cached_property
    def in_turn(self) -> tuple[tuple[str, Compiled], ...]:
        """What is computed, in this order."""
        rates = ((f"{name}_dot", tree) for name, tree in zip(self.variables, entries(self.qdot), strict=True))
        changes = (
            (f"{name}_ddot", tree) for name, tree in zip(self.variables, entries(self.qddot), strict=True)
        )
        first = ((name.name, tree) for name, tree in self.given.items() if isinstance(name, Symbol))
        return tuple((name, compiled(tree)) for name, tree in (*first, *self.q.items(), *rates, *changes))

    def numbers(self, at: Point) -> dict[str, float]:
        """All of them at a point of the symbols and the time. Raises ValueError or ZeroDivisionError out of
        reach and at singular configurations."""
        found = dict(at)
        for name, value in self.in_turn:
            found[name] = value(found)
        return found

    def closed(self) -> tuple[Matrix, Matrix, Matrix]:
        """As functions of the time alone; where that is long, rates in the joint variables, and accelerations
        in both."""
        known = dict(self.given)
        for name, tree in self.q.items():
            known[Symbol(name)] = replace(tree, known)
        rates = tuple(Symbol(f"{name}_dot") for name in self.variables)
        qdot = self._shorter(self.qdot, known)
        known |= dict(zip(rates, entries(qdot), strict=True))
        q = column(known[Symbol(name)] for name in self.variables)
        return q, qdot, self._shorter(self.qddot, known)

    def _shorter(self, tree: Matrix, known: Mapping[Expr, Expr]) -> Matrix:
        """With what is known put in, but for the joints where that would be long."""
        whole = replace(tree, known)
        joints = {Symbol(f"{name}{end}") for name in self.variables for end in ("", "_dot")}
        if isinstance(whole, Matrix) and all(_short(entry) for entry in entries(whole)):
            return whole
        part = replace(tree, {name: value for name, value in known.items() if name not in joints})
        assert isinstance(part, Matrix)
        return part


def followed(
    inverse: Derivation, rates: Derivation, changes: Derivation, where: Coordinates, moving: Moving
) -> Iterator[Followed]:
    """One for each branch. Raises NotDerivable where a joint variable is free."""
    variables = where.problem.subject.variables
    branches = inverse.results["solutions"]
    for branch in branches if isinstance(branches, tuple) else ():
        if not isinstance(branch, Branch):
            raise NotDerivable(MANY)
        values = branch.short or branch.values
        if not {*variables} <= values.keys():
            raise NotDerivable(MANY)
        yield Followed(
            branch, variables, where, values, rates.matrix("qdot"), changes.matrix("qddot"), moving.by_time
        )


def entries(matrix: Matrix) -> tuple[Expr, ...]:
    """Those of a column."""
    return tuple(entry for (entry,) in matrix.rows)


def _short(tree: Expr) -> bool:
    return sum(1 for _ in islice(walk(tree), LONG + 1)) <= LONG
