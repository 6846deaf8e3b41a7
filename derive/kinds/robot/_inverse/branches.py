"""The tree of branches: what each gives for the joint variables, as expressions and in numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.angles import Form, combination
from derive.algebra.numbers.floats import Point
from derive.derivation import Branch, Condition
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Sum,
    Symbol,
    add,
    children,
    free_symbols,
    is_negative,
    rebuild,
    replace,
    terms_of,
    walk,
)  # fmt: skip
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.signs import opposite, ordered
from derive.kinds.robot._inverse.subproblem import (
    Definition,
    Item,
    Taken,
    branches_of,
    defined,
    shares,
    sum_name,
    weighted,
)
from derive.mechanics.inverse.known import determined

LARGEST = 200  # names, numbers and operations in a value; above that it stays in terms of earlier joints
READABLE = 130  # likewise in a value that is printed with everything put in


@dataclass(frozen=True)
class Solutions:
    """The solved sub-problems in order, and the joint variables of the arm. `reached` says of each branch
    whether it brings the end-effector there wherever it is real."""

    items: tuple[Item, ...]
    joints: tuple[str, ...]
    slides: frozenset[str]
    problem: Problem
    free_name: Callable[[str], str]
    reached: tuple[bool, ...] = ()

    @cached_property
    def chosen(self) -> tuple[Taken, ...]:
        """Of each branch the choice at each sub-problem."""
        return tuple(branches_of(self.items))

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """Every branch in the given coordinates, and in short formulas where those are long."""
        whole = [self._whole(taken) for taken in self.chosen]
        names = set(self.joints)
        short = not all(
            size(value) <= READABLE and not free_symbols(value) & names and not _nested(value)
            for values in whole
            for value in values.values()
        )
        reached = self.reached or (True,) * len(self.chosen)
        return tuple(
            Branch(values, when, self._short(taken) if short else {}, true)
            for values, when, taken, true in zip(whole, self.conditions, self.chosen, reached, strict=True)
        )

    @cached_property
    def conditions(self) -> tuple[tuple[Condition, ...], ...]:
        """Which choices make each branch."""
        return tuple(tuple(c.when for c in taken.values() if c.when) for taken in self.chosen)

    @property
    def turning(self) -> tuple[str, ...]:
        """The joint variables that are angles."""
        return tuple(name for name in self.joints if name not in self.slides)

    @property
    def order(self) -> tuple[str, ...]:
        """The names in which a short branch is written, each after those it rests on; empty where every
        branch is in the given coordinates alone."""
        return tuple(self.branches[0].short)

    # -- in numbers -------------------------------------------------------------------------------

    def at(self, point: Point) -> list[dict[str, float] | None]:
        """The joint variables of each branch where the given coordinates have these values; None where the
        branch is not real there. Raises KeyError for a name without a value."""
        found = (self.known(taken, point) for taken in self.chosen)
        return [known and {name: known[name] for name in self.joints} for known in found]

    def known(self, taken: Taken, point: Point) -> dict[str, float] | None:
        """The values of all names in the branch with these choices."""
        known = dict(point)
        forms: list[Form] = []
        values: list[float] = []
        try:
            for item in self.items:
                if isinstance(item, Definition):
                    known[item.name.name] = item.at(known)
                    continue
                value = taken[item.number].at(known)
                if isinstance(item.unknown, str):
                    known[item.unknown] = value
                    continue
                forms.append(item.unknown)
                values.append(value)
                known |= self.angles(forms, values)
        except (ValueError, ZeroDivisionError):
            return None
        return known

    def at_home(self, point: Point) -> dict[str, float]:
        """The point with the names that are defined on the way."""
        return defined(self.items, point)

    def angles(self, forms: Sequence[Form], values: Sequence[float]) -> dict[str, float]:
        """Joint angles with these sums; those nobody knows yet are taken as zero, their sums being right."""
        found = {}
        for joint in self.turning:
            weights = shares(joint, tuple(forms), self.turning)
            found[joint] = sum(n * v for n, v in zip(weights or (), values, strict=bool(weights)))
        return found

    # -- with everything put in -------------------------------------------------------------------

    def _whole(self, taken: Taken) -> dict[str, Expr]:
        """The joint variables in what is given; in earlier ones where that is too long."""
        known: dict[Expr, Expr] = {}
        forms: list[Form] = []
        values: list[Expr] = []
        found: dict[str, Expr] = {}

        def keep(joint: str, value: Expr) -> None:
            found[joint] = value
            if size(value) <= LARGEST:
                known[Symbol(joint)] = value

        for item in self.items:
            tree = item.value if isinstance(item, Definition) else taken[item.number].value
            value = replace(self._summed(tree, known, forms, values), known)
            if isinstance(item, Definition):
                known[item.name] = value
                continue
            if isinstance(item.unknown, str):
                keep(item.unknown, value)
                continue
            forms.append(item.unknown)
            values.append(value)
            if len(item.unknown.parts) > 1:
                known[item.head] = value
            for joint, result in self._fresh(found, forms, values):
                keep(joint, result)
            if size(value) <= LARGEST:
                trig = item.trig.get(taken[item.number].sign, {})
                known |= {key: replace(v, known) for key, v in trig.items()}
        return {name: self._final(found[name]) for name in self.joints}

    def _fresh(
        self, found: Mapping[str, Expr], forms: Sequence[Form], values: Sequence[Expr]
    ) -> Iterator[tuple[str, Expr]]:
        """The joint angles that the latest sum determines, in terms of the values of the sums."""
        for joint in [j for j in self.turning if j not in found and determined(j, forms)]:
            weights = shares(joint, tuple(forms), self.turning) or ()
            yield joint, ordered(_flat(weighted(values, weights)))

    def _summed(
        self, tree: Expr, known: Mapping[Expr, Expr], forms: Sequence[Form], values: Sequence[Expr]
    ) -> Expr:
        """Sums of joint angles that are known though the angles are not, replaced by their values."""
        if isinstance(tree, Sum) and tree not in known:
            joints, rest = self._joint_terms(tree)
            open_ones = [name for name, _ in joints.parts if Symbol(name) not in known]
            weights = combination(joints, forms) if open_ones else None
            if weights is not None:
                return add(weighted(values, [int(n) for n in weights]), *rest)
        return rebuild(tree, lambda part: self._summed(part, known, forms, values))

    def _joint_terms(self, tree: Sum) -> tuple[Form, list[Expr]]:
        """The joint angles in a sum, and its other terms."""
        found: dict[str, int] = {}
        rest: list[Expr] = []
        for term in tree.terms:
            bare = opposite(term) if is_negative(term) else term
            if isinstance(bare, Symbol) and bare.name in self.turning:
                found[bare.name] = -1 if is_negative(term) else 1
            else:
                rest.append(term)
        return Form.of(found), rest

    # -- in short formulas ------------------------------------------------------------------------

    def _short(self, taken: Taken) -> dict[str, Expr]:
        """Every name of the working with its formula, each after those it rests on."""
        forms: list[Form] = []
        sums: list[Expr] = []
        found: dict[str, Expr] = {}
        for item in self.items:
            tree = item.value if isinstance(item, Definition) else taken[item.number].value
            known: dict[Expr, Expr] = {Symbol(name): ZERO for name in found}
            value = self._final(self._summed(tree, known, forms, sums))
            if isinstance(item, Definition):
                found[item.name.name] = value
                continue
            if isinstance(item.unknown, str):
                name = item.unknown
            elif item.named is not None:
                name = item.named.name
            else:
                name = sum_name(item.unknown, self.turning, self.free_name)
            found[name] = value
            if isinstance(item.unknown, Form):
                forms.append(item.unknown)
                sums.append(Symbol(name))
                found |= {joint: self._final(result) for joint, result in self._fresh(found, forms, sums)}
        return _used(found, self.joints)

    def _final(self, value: Expr) -> Expr:
        """With the names of `where` replaced; inside functions nothing is expanded that they do not hold."""
        if not self.problem.where:
            return value
        if plain(value):
            return self.problem.final(value)
        return rebuild(value, self._final)


def _used(found: Mapping[str, Expr], wanted: Iterable[str]) -> dict[str, Expr]:
    """The names that these rest on, in the order they have."""
    used = set(wanted)
    for name, value in reversed([*found.items()]):
        if name in used:
            used |= free_symbols(value)
    return {name: value for name, value in found.items() if name in used}


def size(tree: Expr) -> int:
    """How many nodes a tree has."""
    return sum(1 for _ in walk(tree))


def plain(tree: Expr) -> bool:
    """Whether it holds no inverse function and no root."""
    return not any(isinstance(node, Call) and node.function in ("atan2", "sqrt") for node in walk(tree))


def _nested(tree: Expr) -> bool:
    """Whether a root stands inside a root."""
    roots = [node for node in walk(tree) if _is_root(node)]
    return any(_is_root(inner) for root in roots for part in children(root) for inner in walk(part))


def _is_root(tree: Expr) -> bool:
    return isinstance(tree, Call) and tree.function == "sqrt"


def _flat(tree: Expr) -> Expr:
    """A sum of sums as one sum."""
    if not isinstance(tree, Sum):
        return tree
    return Sum(tuple(inner for term in tree.terms for inner in terms_of(_flat(term))))
