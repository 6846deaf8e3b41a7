"""An answer, its steps and what was verified of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeAlias, TypeVar

from derive.algebra.readable.terms import Style
from derive.derivation.pictures import (
    Figure,
)
from derive.derivation.said import (
    Cell,
    Condition,
    Phrase,
    Record,
    Said,
)
from derive.errors import NotDerivable
from derive.expression import Expr, Matrix, Symbol, add, multiply


class PageFacts(Record):
    """What the words read of an answer beside its steps; a kind declares its own as `class Facts(PageFacts)`.

    `numbers` are the results worth printing where they are evaluated (None: all), `page_names` says what they
    are called on the page; with `met` only the branches that are met are listed. `angle_results` are angles,
    in degrees where the `style` is; `short_names` are angles whose sine is printed s_\\phi. With `labels`,
    one for each solution at a point, these are a table; `remark` is what is said after the numbers, and
    angles are `in_degrees` though nobody typed any. The names in a matrix, `at_pose`, are told by it at a
    point; angles of a feasible solution are within their `turn_limits`. Vectors that are `lying` are rows on
    the page; those `by_joint` have an entry for each joint and are no twists, even of six. Matrices of
    `forms` are quadratic forms in a twist.
    """

    numbers: tuple[str, ...] | None = None
    page_names: Mapping[str, str | Expr] = field(default_factory=dict)
    met: bool = False
    angle_results: tuple[str, ...] = ()
    lying: tuple[str, ...] = ()
    by_joint: tuple[str, ...] = ()
    forms: tuple[str, ...] = ()
    style: Style = Style()
    short_names: tuple[str, ...] = ()
    labels: tuple[Cell, ...] = ()
    turn_limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    remark: Phrase | None = None
    in_degrees: bool = False
    at_pose: tuple[Expr, Matrix] | None = None


F = TypeVar("F", bound=PageFacts)
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Step:
    """One move of a derivation.

    `chain` holds expressions each equal to the next, the answer of the step last. `rule` is the
    law that justifies it, by name. `facts` is the record of what the words read of it (an index, a name),
    `steps` are the smaller moves inside this one. A step of rule "law" holds in general; `instance` says what
    its names stand for in the case in which it is tried.

    How much of it fits on a page, the page decides: links that are `spare` are left out where they are long,
    and entries of a matrix at the end, by row and column from 0, get the names in `entries`.
    """

    name: str
    chain: tuple[Expr, ...] = ()
    rule: str = ""
    facts: Record = field(default_factory=Record)
    steps: tuple[Step, ...] = ()
    spare: tuple[Expr, ...] = ()
    entries: Mapping[tuple[int, int], Symbol] = field(default_factory=dict)
    instance: Mapping[Expr, Expr] = field(default_factory=dict)

    def all(self) -> Iterator[Step]:
        """This step, then those inside it."""
        yield self
        for step in self.steps:
            yield from step.all()

    @property
    def result(self) -> Expr:
        return self.chain[-1]


@dataclass(frozen=True, slots=True)
class Claim:
    """Something verified about a derivation: what, as a phrase, by which means, and whether it holds.

    A `link` says that a chain is equal from end to end. That holds of any formula, right or wrong, whose
    value is computed from it: it proves no answer. `tried` counts the places, points or entries at which it
    was looked at: what was looked at nowhere does not hold.
    """

    key: str
    by: str
    holds: bool
    about: Mapping[str, Said] = field(default_factory=dict)
    link: bool = False
    tried: int = 1

    def __post_init__(self) -> None:
        object.__setattr__(self, "holds", bool(self.holds) and self.tried > 0)

    @property
    def truth(self) -> str:
        """What kind of proof it is: a "step" from line to line or to a result, a "law", a "second-route", or
        a "number" found again at a point."""
        if self.link:
            return "step"
        return {"normal-form": "law", "ball-arithmetic": "number"}.get(self.by, "second-route")

    def within(self, key: str, **about: Said) -> Claim:
        """The same claim as part of another phrase, whose field `claim` it fills."""
        return replace(self, key=key, about={**about, "claim": Phrase(self.key, self.about)})


@dataclass(frozen=True, slots=True)
class Branch:
    """One solution among several: the value of each unknown, and when it is the one.

    `short` has the values in terms of names found before them, with these names, in the order in which they
    are evaluated; it is what a result says where the values by themselves are long. `true_at` is False of a
    branch that need not solve all that is asked. `facts` are plain values beside it in the results.
    """

    values: Mapping[str, Expr]
    when: tuple[Condition, ...]
    short: Mapping[str, Expr] = field(default_factory=dict)
    true_at: bool = True
    facts: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class LinearSystem:
    """Equations in place of a formula that would fill pages: `left` (n by n) times the unknowns is `right`
    (n by 1). The result is the first of the unknowns, as many as are `wanted`; the others are found with
    them, and where it is a matrix, row by row, it has so many `columns`. `names` stand in the equations for
    what is given with them."""

    unknowns: tuple[Symbol, ...]
    left: Matrix
    right: Matrix
    wanted: int
    names: Mapping[str, Expr] = field(default_factory=dict)
    columns: int = 1

    def shaped(self, values: Sequence[T]) -> list[T] | list[list[T]]:
        """What each of the unknowns that are wanted is, in the shape of the result."""
        found = [*values[: self.wanted]]
        if self.columns == 1:
            return found
        return [found[k : k + self.columns] for k in range(0, self.wanted, self.columns)]

    def __hash__(self) -> int:
        return hash((self.unknowns, self.left, self.right))

    @property
    def equations(self) -> tuple[tuple[Expr, Expr], ...]:
        """Both sides of each, written out."""
        rows = zip(self.left.rows, self.right.rows, strict=True)
        return tuple((add(*map(multiply, row, self.unknowns)), right) for row, (right,) in rows)


Result: TypeAlias = (
    Expr
    | tuple[Branch, ...]
    | tuple[tuple[Expr, ...], ...]
    | tuple[Condition, ...]
    | tuple[Expr | str, ...]
    | LinearSystem
    | Phrase
    | float
    | str
)


@dataclass(frozen=True, slots=True)
class Derivation:
    """The answer to one question.

    `results` and `evaluated` are named as in the JSON contract. `definitions` says what each name
    in the chains stands for, so that every chain can be checked from end to end. `uses` are the
    derivations this one rests on, printed before it unless an earlier question printed them; of the kinds
    that are `unread` it needs what they show on the way, and no long result written out.
    `files` are texts written beside the page, by file name: scripts to run. `matrices` names the results
    that are matrices even where they have one column only (J of one joint), and no vectors. `alone` are
    those that could be compared with no line. `units` are the SI units of names on the page, "N m"; their
    numbers are printed with them. `meant` are those of results, where the author typed units at all. Results
    may hold names of others, as long rates those of the joints that are results too: `in_turn` says what
    these come to.
    """

    kind: str
    steps: tuple[Step, ...]
    results: Mapping[str, Result]
    claims: tuple[Claim, ...] = ()
    definitions: Mapping[Expr, Expr] = field(default_factory=dict)
    evaluated: Mapping[str, Any] = field(default_factory=dict)
    uses: tuple[Derivation, ...] = ()
    unread: frozenset[str] = frozenset()
    plots: tuple[Figure, ...] = ()
    facts: PageFacts = field(default_factory=PageFacts)
    files: Mapping[str, str] = field(default_factory=dict)
    matrices: frozenset[str] = frozenset()
    alone: tuple[str, ...] = ()
    units: Mapping[Expr | Phrase, str] = field(default_factory=dict)
    meant: Mapping[str, str] = field(default_factory=dict)
    in_turn: Mapping[str, Expr] = field(default_factory=dict)

    def told(self, shape: type[F]) -> F:
        """The facts, of the shape that the kind of this derivation declares. Raises TypeError for another."""
        if not isinstance(self.facts, shape):
            raise TypeError(f"the facts of {self.kind} are no {shape.__module__}.{shape.__name__}")
        return self.facts

    @property
    def proved(self) -> bool:
        """Whether a law or an independent route speaks for this answer, or for one that it rests on."""
        return any(not claim.link for claim in self.claims) or any(used.proved for used in self.uses)

    def matrix(self, name: str) -> Matrix:
        """A result that is a matrix. Raises TypeError for any other."""
        return as_matrix(self.results[name], name)

    def scalar(self, name: str) -> Expr:
        """A result that is a scalar expression. Raises TypeError for any other."""
        value = self.results[name]
        if isinstance(value, tuple | LinearSystem | Phrase | str | float | Matrix):
            raise TypeError(f"{name} is no scalar")
        return value

    def step(self, name: str) -> Step:
        """The step of this name, however deep. Raises KeyError."""
        for step in self.all_steps():
            if step.name == name:
                return step
        raise KeyError(name)

    def all_steps(self) -> Iterator[Step]:
        """Every step, outer ones first, in the order of the page."""
        for step in self.steps:
            yield from step.all()


def has_equations(derivation: Derivation) -> bool:
    """Whether equations stand in place of one of its results."""
    return any(isinstance(result, LinearSystem) for result in derivation.results.values())


def as_matrix(value: Result, name: str) -> Matrix:
    """A result that is a matrix. Raises NotDerivable where equations stand in its place, TypeError for any
    other."""
    if isinstance(value, LinearSystem):
        raise NotDerivable(f"this rests on {name}, whose formula would fill pages")
    if not isinstance(value, Matrix):
        raise TypeError(f"{name} is no matrix")
    return value
