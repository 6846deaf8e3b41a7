"""A solved sub-problem: a joint variable, or a sum of them, by those found before; and the branches."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from math import prod
from typing import TypeAlias

from derive.algebra.angles import Form, combination
from derive.algebra.numbers.compiled import Compiled, compiled
from derive.algebra.numbers.floats import Point
from derive.derivation import Condition, Step
from derive.expression import ZERO, Expr, Relation, Symbol, add, multiply, number
from derive.kinds.robot._inverse.facts import Compared, SolvedFacts
from derive.kinds.robot._inverse.signs import opposite
from derive.mechanics.inverse.known import completed


@dataclass(frozen=True)
class Formula:
    """A value as it is written."""

    value: Expr

    @cached_property
    def at(self) -> Compiled:
        """The value in numbers. Raises as `compiled` does."""
        return compiled(self.value)


@dataclass(frozen=True)
class Choice(Formula):
    """One value of the unknown: chosen freely by `sign`, or where the signs chosen at earlier sub-problems
    have this product. `when` says which it is; 0 is no choice. `told` is what has the sign, as a
    page has it."""

    sign: int = 0
    when: Condition | None = None
    earlier: tuple[int, ...] = ()
    product: int = 1
    told: Expr | None = None

    @property
    def signed(self) -> Expr | None:
        """What has the sign of the choice."""
        if self.told is None and isinstance(self.when, Relation) and not isinstance(self.when.left, Relation):
            return self.when.left
        return self.told

    def fits(self, signs: Mapping[int, int]) -> bool:
        """Whether it goes with the signs chosen at earlier sub-problems, by their numbers."""
        return not self.earlier or prod(signs[each] for each in self.earlier) == self.product


@dataclass(frozen=True)
class Definition(Formula):
    """A name for a quantity that is known by then."""

    name: Symbol


@dataclass(frozen=True)
class Solved:
    """`number` counts the sub-problems from 0; `unknown` is a sum of angles or the name of a displacement,
    `head` how it is written, `stage` that of its equations ("whole", "arm" or "hand"); `trig` are the sine
    and cosine of that sum where they are known without it, by sign; it was solved by its `equations`. A sum
    that the page goes on with by a name is `named`."""

    number: int
    unknown: Form | str
    head: Expr
    choices: tuple[Choice, ...]
    steps: tuple[Step, ...]
    facts: SolvedFacts
    stage: str
    trig: Mapping[int, Mapping[Expr, Expr]] = field(default_factory=dict)
    equations: tuple[tuple[Expr, Expr], ...] = ()
    compared: tuple[Compared, ...] = ()  # where they were read
    named: Symbol | None = None

    @cached_property
    def sum_at(self) -> Compiled:
        """What the unknown is in numbers, as it is written. Raises as `compiled` does."""
        return compiled(self.head)

    @property
    def two_valued(self) -> bool:
        """Whether there is a choice to make, rather than one made already."""
        return len(self.choices) > 1 and any(choice.sign for choice in self.choices)


Item: TypeAlias = Definition | Solved
Taken: TypeAlias = Mapping[int, Choice]  # of a branch: the choice at each sub-problem, by its number


def defined(items: Iterable[Item], at: Point) -> dict[str, float]:
    """The point with the names that are defined on the way, where those have values."""
    known = dict(at)
    for item in items:
        name = item.name if isinstance(item, Definition) else item.named
        if name is not None:
            with suppress(KeyError, ValueError, ZeroDivisionError):
                known[name.name] = item.at(known) if isinstance(item, Definition) else item.sum_at(known)
    return known


DIGITS = "0123456789"


def sum_name(form: Form, joints: Sequence[str], free_name: Callable[[str], str]) -> str:
    """A joint angle by its own name; a sum by the stem and the numbers, theta234, or else phi_23."""
    names = sorted((atom for atom, _ in form.parts), key=joints.index)
    if len(names) == 1:
        return names[0]
    stem = names[0].rstrip(DIGITS)
    numbers = "".join(name[len(stem) :] for name in names)
    alike = all(name.rstrip(DIGITS) == stem for name in names) and all(n == 1 for _, n in form.parts)
    if alike and numbers.isdigit():
        return free_name(f"{stem}{numbers}")
    return free_name(f"phi_{numbers if numbers.isdigit() else '_'.join(names)}")


def branches_of(items: Sequence[Item]) -> Iterator[Taken]:
    """Every branch."""
    yield from _branches([item for item in items if isinstance(item, Solved)], {}, {})


def _branches(solved: Sequence[Solved], signs: dict[int, int], taken: dict[int, Choice]) -> Iterator[Taken]:
    if not solved:
        yield taken
        return
    first, *rest = solved
    for choice in first.choices:
        if choice.fits(signs):
            here = {**signs, first.number: choice.sign} if choice.sign else signs
            yield from _branches(rest, here, {**taken, first.number: choice})


def course(solved: Solved, before: Sequence[Solved], turning: Sequence[str]) -> dict[str, float]:
    """How fast each joint goes where the unknown goes by one and what was found `before` stands still."""
    import numpy as np

    if isinstance(solved.facts.method.half, Symbol):
        return {solved.facts.method.half.name: 0.5}
    if isinstance(solved.unknown, str):
        return {solved.unknown: 1.0}
    forms = [*(each.unknown for each in before if isinstance(each.unknown, Form)), solved.unknown]
    rows = np.array([[float(dict(form.parts).get(name, 0)) for name in turning] for form in forms])
    rates = np.linalg.lstsq(rows, np.eye(len(forms))[-1], rcond=None)[0]
    return dict(zip(turning, map(float, rates), strict=True))


@lru_cache(maxsize=1024)
def shares(joint: str, forms: tuple[Form, ...], joints: tuple[str, ...]) -> tuple[int, ...] | None:
    """How a joint angle is made up of known sums, the angles nobody knows yet taken as zero."""
    found = combination(Form.of({joint: 1}), completed(forms, joints))
    return tuple(int(n) for n in found[: len(forms)]) if found else None


def weighted(values: Sequence[Expr], weights: Sequence[int]) -> Expr:
    """A sum of values with whole weights; -1 turns the signs of all terms."""
    terms = [
        opposite(value) if n == -1 else multiply(number(n), value)
        for value, n in zip(values, weights, strict=True)
        if n
    ]
    return add(*terms) if terms else ZERO
