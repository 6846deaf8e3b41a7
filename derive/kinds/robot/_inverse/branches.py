"""The tree of branches: what each gives for the joint variables, as expressions and in numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from derive.algebra.angles import Form, combination
from derive.algebra.numbers.compiled import Compiled, compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Branch
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
)  # fmt: skip
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.moves import Definition, Item, Option, choices, shares, weighted
from derive.kinds.robot._inverse.trees import minus, ordered

LARGEST = 1200  # names, numbers and operations in a value; above that it stays in terms of earlier joints
DIGITS = "0123456789"
READABLE = 130  # likewise in a value that is printed with everything put in


@dataclass(frozen=True)
class Solutions:
    """The moves in order, and the joint variables of the arm. `reached` says of each branch whether it brings
    the end-effector there wherever it is real."""

    items: tuple[Item, ...]
    joints: tuple[str, ...]
    slides: frozenset[str]
    problem: Problem
    free_name: Callable[[str], str]
    reached: tuple[bool, ...] = ()

    @cached_property
    def chosen(self) -> tuple[dict[int, Option], ...]:
        return tuple(choices(self.items))

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """Every branch in the given coordinates, and in short formulas where those are long."""
        whole = [self._whole(taken) for taken in self.chosen]
        names = set(self.joints)
        short = not all(
            size(value) <= READABLE and not _holds(value, names) and not _nested(value)
            for values in whole
            for value in values.values()
        )
        reached = self.reached or (True,) * len(self.chosen)
        return tuple(
            Branch(values, ", ".join(when), self._short(taken) if short else {}, true)
            for values, when, taken, true in zip(whole, self.conditions, self.chosen, reached, strict=True)
        )

    @cached_property
    def conditions(self) -> tuple[tuple[str, ...], ...]:
        """Which choices make each branch."""
        return tuple(tuple(o.when for o in taken.values() if o.when) for taken in self.chosen)

    @property
    def turning(self) -> tuple[str, ...]:
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
        return [self._at(taken, dict(point)) for taken in self.chosen]

    @cached_property
    def _functions(self) -> dict[int, Compiled]:
        """Every definition and option as a function."""
        parts: list[Definition | Option] = []
        for item in self.items:
            parts += [item] if isinstance(item, Definition) else item.options
        return {id(part): compiled(part.value) for part in parts}

    def value(self, part: Definition | Option, known: Point) -> float:
        """Of a definition or an option, by what is known."""
        return self._functions[id(part)](known)

    def _at(self, taken: Mapping[int, Option], known: dict[str, float]) -> dict[str, float] | None:
        forms: list[Form] = []
        values: list[float] = []
        try:
            for item in self.items:
                part = item if isinstance(item, Definition) else taken[item.number]
                value = self.value(part, known)
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

    # -- with everything put in -------------------------------------------------------------------

    def _whole(self, taken: Mapping[int, Option]) -> dict[str, Expr]:
        """The joint variables in what is given; in earlier ones where that is too long."""
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
            for joint, result in self._fresh(found, forms, values):
                self._keep(joint, result, known, found)
            if size(value) <= LARGEST:
                known |= {key: replace(v, known) for key, v in item.trig.get(sign, {}).items()}
        return {name: self._final(found[name]) for name in self.joints}

    def _fresh(
        self, found: Mapping[str, Expr], forms: Sequence[Form], values: Sequence[Expr]
    ) -> Iterator[tuple[str, Expr]]:
        """The joint angles that the latest sum determines, in terms of the values of the sums."""
        for joint in [j for j in self.turning if j not in found and self._fixed(j, forms)]:
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

    # -- in short formulas ------------------------------------------------------------------------

    def _short(self, taken: Mapping[int, Option]) -> dict[str, Expr]:
        """Every name of the working with its formula, each after those it rests on."""
        forms: list[Form] = []
        sums: list[Expr] = []
        found: dict[str, Expr] = {}

        def written(tree: Expr) -> Expr:
            known: dict[Expr, Expr] = {Symbol(name): ZERO for name in found}
            return self._final(self._summed(tree, known, forms, sums))

        for item in self.items:
            if isinstance(item, Definition):
                found[item.name.name] = written(item.value)
                continue
            value = written(taken[item.number].value)
            name = item.of if isinstance(item.of, str) else self._name(item.of)
            found[name] = value
            if isinstance(item.of, Form):
                forms.append(item.of)
                sums.append(Symbol(name))
                found |= {joint: self._final(result) for joint, result in self._fresh(found, forms, sums)}
        return _used(found, self.joints)

    def _name(self, form: Form) -> str:
        """A joint angle by its own name; a sum by the stem and the numbers, theta234, or else phi_23."""
        names = sorted((atom for atom, _ in form.parts), key=self.turning.index)
        if len(names) == 1:
            return names[0]
        stem = names[0].rstrip(DIGITS)
        numbers = "".join(name[len(stem) :] for name in names)
        alike = all(name.rstrip(DIGITS) == stem for name in names) and all(n == 1 for _, n in form.parts)
        if alike and numbers.isdigit():
            return self.free_name(f"{stem}{numbers}")
        return self.free_name(f"phi_{numbers if numbers.isdigit() else '_'.join(names)}")

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
    return 1 + sum(map(size, children(tree)))


def plain(tree: Expr) -> bool:
    """Whether it holds no inverse function and no root."""
    if isinstance(tree, Call) and tree.function in ("atan2", "sqrt"):
        return False
    return all(map(plain, children(tree)))


def _holds(tree: Expr, names: set[str]) -> bool:
    if isinstance(tree, Symbol):
        return tree.name in names
    return any(_holds(part, names) for part in children(tree))


def _nested(tree: Expr, inside: bool = False) -> bool:
    """Whether a root stands inside a root."""
    root = isinstance(tree, Call) and tree.function == "sqrt"
    return (root and inside) or any(_nested(part, inside or root) for part in children(tree))


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
