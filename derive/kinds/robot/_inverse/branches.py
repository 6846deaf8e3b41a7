"""The tree of branches: what each gives for the joint variables, as expressions and in numbers."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.angles import Form, combination
from derive.algebra.compiled import Compiled, compiled
from derive.algebra.numeric import Point
from derive.derivation import Branch
from derive.expression import Call, Expr, Sum, Symbol, add, children, is_negative, rebuild, replace
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.moves import Definition, Item, Move, Option, choices, shares, weighted
from derive.kinds.robot._inverse.trees import minus

LARGEST = 1200  # names, numbers and operations in a value; above that it stays in terms of earlier joints


@dataclass(frozen=True)
class Solutions:
    """The moves in order, and the joint variables of the arm."""

    items: tuple[Item, ...]
    joints: tuple[str, ...]
    slides: frozenset[str]
    problem: Problem

    @cached_property
    def chosen(self) -> tuple[dict[int, Option], ...]:
        return tuple(choices(self.items))

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """Every branch in the given coordinates; long values in terms of joints found before."""
        return tuple(self._branch(taken) for taken in self.chosen)

    @property
    def turning(self) -> tuple[str, ...]:
        return tuple(name for name in self.joints if name not in self.slides)

    @cached_property
    def order(self) -> tuple[str, ...]:
        """The joint variables in the order in which they become known."""
        found: list[str] = []
        forms: list[Form] = []
        for item in self.items:
            if isinstance(item, Move) and isinstance(item.of, Form):
                forms.append(item.of)
                found += [j for j in self.turning if j not in found and self._fixed(j, forms)]
            elif isinstance(item, Move) and isinstance(item.of, str):
                found.append(item.of)
        return tuple(found)

    @cached_property
    def nested(self) -> bool:
        """Whether values refer to joint variables found before them."""
        names = set(self.joints)
        return any(_holds(value, names) for branch in self.branches for value in branch.values.values())

    # -- in numbers -------------------------------------------------------------------------------

    def at(self, point: Point) -> list[dict[str, float] | None]:
        """The joint variables of each branch where the given coordinates have these values; None where the
        branch is not real there. Raises KeyError for a name without a value."""
        return [self._at(taken, dict(point)) for taken in self.chosen]

    @cached_property
    def _functions(self) -> dict[int, Compiled]:
        """Every definition and option as a function."""
        parts: list[Definition | Option] = []
        for item in self.items:
            parts += [item] if isinstance(item, Definition) else item.options
        return {id(part): compiled(part.value) for part in parts}

    def _at(self, taken: Mapping[int, Option], known: dict[str, float]) -> dict[str, float] | None:
        forms: list[Form] = []
        values: list[float] = []
        try:
            for item in self.items:
                part = item if isinstance(item, Definition) else taken[item.number]
                value = self._functions[id(part)](known)
                if isinstance(item, Definition):
                    known[item.name.name] = value
                elif isinstance(item.of, Form):
                    forms.append(item.of)
                    values.append(value)
                    known |= self.angles(forms, values)
                else:
                    known[item.of] = value
        except (ValueError, ZeroDivisionError):
            return None
        return {name: known[name] for name in self.joints}

    def angles(self, forms: Sequence[Form], values: Sequence[float]) -> dict[str, float]:
        """Joint angles with these sums; those nobody knows yet are taken as zero, their sums being right."""
        found = {}
        for joint in self.turning:
            weights = shares(joint, tuple(forms), self.turning)
            found[joint] = sum(n * v for n, v in zip(weights or (), values, strict=bool(weights)))
        return found

    # -- as expressions ---------------------------------------------------------------------------

    def _branch(self, taken: Mapping[int, Option]) -> Branch:
        known: dict[Expr, Expr] = {}
        forms: list[Form] = []
        values: list[Expr] = []
        found: dict[str, Expr] = {}
        for item in self.items:
            if isinstance(item, Definition):
                known[item.name] = replace(self._summed(item.value, known, forms, values), known)
                continue
            value = replace(self._summed(taken[item.number].value, known, forms, values), known)
            if isinstance(item.of, str):
                self._keep(item.of, value, known, found)
                continue
            forms.append(item.of)
            values.append(value)
            if len(item.of.parts) > 1:
                known[item.head] = value
            sign = taken[item.number].sign
            fresh = [j for j in self.turning if j not in found and self._fixed(j, forms)]
            for joint in fresh:
                weights = shares(joint, tuple(forms), self.turning) or ()
                self._keep(joint, _flat(weighted(values, weights)), known, found)
            if size(value) <= LARGEST:
                known |= {key: replace(v, known) for key, v in item.trig.get(sign, {}).items()}
        when = ", ".join(option.when for option in taken.values() if option.when)
        return Branch({name: self._final(found[name]) for name in self.joints}, when)

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
            bare = minus(term) if is_negative(term) else term
            if isinstance(bare, Symbol) and bare.name in self.turning:
                found[bare.name] = -1 if is_negative(term) else 1
            else:
                rest.append(term)
        return Form.of(found), rest

    def _keep(self, joint: str, value: Expr, known: dict[Expr, Expr], found: dict[str, Expr]) -> None:
        found[joint] = value
        if size(value) <= LARGEST:
            known[Symbol(joint)] = value

    def _fixed(self, joint: str, forms: Sequence[Form]) -> bool:
        """Whether these sums determine a joint angle."""
        return combination(Form.of({joint: 1}), forms) is not None

    def _final(self, value: Expr) -> Expr:
        """With the names of `where` replaced; inside functions nothing is expanded that they do not hold."""
        if not self.problem.where:
            return value
        if _plain(value):
            return self.problem.final(value)
        return rebuild(value, self._final)


def size(tree: Expr) -> int:
    """How many nodes a tree has."""
    return 1 + sum(map(size, children(tree)))


def _plain(tree: Expr) -> bool:
    """Whether it holds no inverse function and no root."""
    if isinstance(tree, Call) and tree.function in ("atan2", "sqrt"):
        return False
    return all(map(_plain, children(tree)))


def _holds(tree: Expr, names: set[str]) -> bool:
    if isinstance(tree, Symbol):
        return tree.name in names
    return any(_holds(part, names) for part in children(tree))


def _flat(tree: Expr) -> Expr:
    """A sum of sums as one sum."""
    if not isinstance(tree, Sum):
        return tree
    return Sum(tuple(_terms(tree)))


def _terms(tree: Sum) -> Iterator[Expr]:
    for term in tree.terms:
        if isinstance(term, Sum):
            yield from _terms(term)
        else:
            yield term
