"""What a sentence says in mathematics is not the opposite of what is said elsewhere.

A formula within a sentence is part of no chain, so no link between lines holds it. It is looked for in what
is verified elsewhere, and typed: where only its negative is found the sentence is wrong. What a page gives is
wrong too where a relation between the same sides was typed with another sign.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from math import isclose, radians
from typing import Any, get_args

from derive.derivation import Derivation, Phrase
from derive.expression import (
    Approximate,
    Call,
    Degrees,
    Expr,
    Indexed,
    Matrix,
    Measured,
    Number,
    Relation,
    Symbol,
    children,
    every,
    free_symbols,
    held,
    is_negative,
    negate,
    number,
    replace,
    terms_of,
)
from derive.given.datum import Datum
from derive.given.tabled import mistabled
from derive.kinds.problem import Problem
from derive.kinds.robot._ranges import ranges_told
from derive.kinds.somewhere import Somewhere, contradicted, values_of
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.robot import Robot

OWN: Mapping[str, str] = {"axis": "letter", "screws": "table"}  # with signs of their own, held elsewhere
TREES = get_args(Expr)
NUMBERS = (Number, Approximate, Degrees)
NAMES = (Symbol, Indexed)
Formula = Expr | Relation
Pair = tuple[Expr, str, Expr]
SAME = 1e-12
RANGES = "ranges"  # a field that lists those that were typed
OPPOSITE = {"=": "!=", "!=": "=", "<=": ">=", ">=": "<="}
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


def misquoted(answer: Derivation, options: Any, problem: Problem) -> Iterator[str]:
    """The fields of phrases, as `key.field`, that hold the opposite of what is verified."""
    known: Known = problem.memo.seen.setdefault("quoted", Known())
    checked: dict[int, Derivation] = problem.memo.seen.setdefault("checked", {})
    told = [*_rested_on(answer)]
    new = [each for each in told if id(each) not in checked]
    checked |= {id(each): each for each in new}
    for each in new:
        known.take(_outside(each))
    known.take((options, problem.where, problem.points, *_typed(problem.subject)))
    names = {name: value for each in told for name, value in each.definitions.items()}
    said = [
        (each.facts, each.plots, each.results, *(step.facts for step in each.all_steps())) for each in new
    ]
    yield from Board(known, Somewhere(names)).strange(_phrases(said))


def misgiven(data: Iterable[Datum], options: Any, problem: Problem) -> Iterator[str]:
    """The same of what the page says that a problem gives, or a question: by its table and equations too, and
    of its numbers."""
    typed, given = Known(), (options, problem.where, problem.points, *_typed(problem.subject))
    typed.take(given)
    board = Board(typed, Somewhere({}), typed=True)
    for datum in data:
        yield from board.strange(_phrases(datum))
        rows = datum.table.rows if datum.table else ()
        shown = _formulas(tuple(_mathematics((rows, datum.equations))))
        held = OWN.get(datum.said.key) == "table"
        if not held and (any(map(board.denies, shown)) or mistabled(rows, given)):
            yield datum.said.key


def _typed(subject: Any) -> tuple[Any, ...]:
    """A subject, and what an arm has of ranges and of gravity, which may be left out."""
    return (subject, ranges_told(subject), gravity_of(subject)) if isinstance(subject, Robot) else (subject,)


def _rested_on(answer: Derivation) -> Iterator[Derivation]:
    yield answer
    for used in answer.uses:
        yield from _rested_on(used)


def _phrases(value: Any) -> Iterator[Phrase]:
    return (part for part in every(value) if isinstance(part, Phrase))


def _formulas(said: Any) -> Iterator[Formula]:
    """Those of a field, joint variables without the star that tables give them."""
    match said:
        case tuple():
            for each in said:
                yield from _formulas(each)
        case Relation():
            yield said
        case _ if isinstance(said, TREES):
            stars: dict[Expr, Expr] = {
                Symbol(name): Symbol(name[:-1]) for name in free_symbols(said) if name.endswith("*")
            }
            yield replace(said, stars)


@dataclass(frozen=True, slots=True)
class Known:
    """Mathematics outside of sentences, each part of a formula by itself, by what it is and of how many
    parts. Formulas that were taken in are not again."""

    waiting: list[Any] = field(default_factory=list)  # values that are taken in once they are needed
    parts: dict[tuple[type, int], list[Expr]] = field(default_factory=lambda: defaultdict(list))
    pairs: set[Pair] = field(default_factory=set)
    taken: dict[int, Expr] = field(default_factory=dict)

    def take(self, value: Any) -> None:
        """All in a value."""
        self.waiting.append(value)

    def _settle(self) -> None:
        while self.waiting:
            for found in _mathematics(self.waiting.pop()):
                if isinstance(found, Relation):
                    self.pairs.update(_pairs(found))
                for tree in _sides(found) if isinstance(found, Relation) else (found,):
                    if id(tree) not in self.taken:
                        self.taken[id(tree)] = tree
                        self._gather(tree)

    @property
    def relations(self) -> set[Pair]:
        """Pairs of sides with the sign between them."""
        self._settle()
        return self.pairs

    def _gather(self, tree: Expr) -> None:
        pending = [tree]
        while pending:
            node = pending.pop()
            parts = children(node)
            self.parts[type(node), len(parts)].append(node)
            pending.extend(parts)

    def has(self, tree: Expr) -> bool:
        """Whether it stands here, as a whole or as a part; a number by its size."""
        self._settle()
        if not isinstance(tree, NUMBERS):
            return tree in self.parts.get((type(tree), len(children(tree))), ())
        found = (node for kind in NUMBERS for node in self.parts.get((kind, 0), ()))
        return any(
            isclose(a, b, rel_tol=SAME) for node in found for a in _values(node) for b in _values(tree)
        )


@dataclass(frozen=True, slots=True)
class Board:
    """All that is verified elsewhere, and what names mean. Where all is `typed` numbers are judged too,
    and names that stand nowhere are not."""

    known: Known
    at: Somewhere
    typed: bool = False

    def strange(self, phrases: Iterable[Phrase]) -> Iterator[str]:
        """The fields with a formula of which this says the opposite."""
        for phrase in phrases:
            for name, said in phrase.about.items():
                judge = self._has_no_range if name == RANGES else self.denies
                formulas = [*_formulas(said)]
                signed = [-each for each in formulas if not isinstance(each, Relation)]  # j and -j, both
                wrong = (judge(each) for each in formulas if each not in signed)
                if OWN.get(phrase.key) != name and any(wrong):
                    yield f"{phrase.key}.{name}"

    def denies(self, formula: Formula) -> bool:
        """Whether the opposite stands here, and it does not."""
        if not isinstance(formula, Relation):
            return (self.typed or _has_minus(formula)) and self._denies(formula)
        if not self.typed and "!=" not in _signs(formula):
            return False  # an answer has cases and equations of its own: x = 0 and x != 0, y = -x
        strange, sides = {*_pairs(formula)} - self.known.relations, _sides(formula)
        if any(sign == "!=" for _, sign, _ in strange):
            return self.typed or self._equal(sides)
        if not strange:
            return False
        if any((a, OPPOSITE.get(sign), b) in self.known.relations for a, sign, b in strange):
            return True
        return not self._equal(sides) and any(map(self._denies, sides))

    def _has_no_range(self, formula: Formula) -> bool:
        return not isinstance(formula, Relation) or not self.known.relations.issuperset(_pairs(formula))

    def _equal(self, sides: list[Expr]) -> bool:
        """Whether they are, by what names mean."""
        values = [*values_of(sides, self.at)]
        return len(values) == len(sides) and not contradicted(sides, self.at)

    def _denies(self, tree: Expr) -> bool:
        if isinstance(tree, Measured):
            return self._denies(tree.value)
        if isinstance(tree, NUMBERS) and (not self.typed or _is_count(tree)):
            return False  # one that was found may be the opposite of another
        if (
            isinstance(tree, NAMES)
            or self.known.has(tree)
            or (isinstance(tree, Matrix) and tree.shape[1] > 1)
        ):
            return False
        if isinstance(tree, Matrix) or (isinstance(tree, Call) and tree.function == "diag"):
            return any(map(self._denies, children(tree)))  # it may be put together of what is typed
        opposite = negate(tree)
        opposite = opposite.value if isinstance(opposite, Measured) else opposite
        return (isinstance(opposite, NAMES) and not self.typed) or self.known.has(opposite)


def _has_minus(tree: Expr) -> bool:
    """Whether a minus stands in front of it, or of an entry."""
    if isinstance(tree, Matrix):
        return any(map(_has_minus, children(tree)))
    return is_negative(terms_of(tree)[0])


def _signs(said: Relation) -> set[str]:
    return {said.sign} | (_signs(said.left) if isinstance(said.left, Relation) else set())


def _is_count(tree: Expr) -> bool:
    return isinstance(tree, Number) and not tree.decimal and tree.value.denominator == 1 and tree.value > 0


def _outside(answer: Derivation) -> Iterator[Any]:
    yield answer.definitions
    yield answer.results
    yield (answer.facts, *(step.facts for step in answer.all_steps()))
    for step in answer.all_steps():
        yield step.chain
        yield step.entries


def _mathematics(value: Any) -> Iterator[Formula]:
    match value:
        case Phrase():
            return
        case Relation():
            yield value
        case int():
            yield number(int(value))
        case _ if isinstance(value, TREES):
            yield value
        case _:
            for each in held(value):
                yield from _mathematics(each)


def _sides(said: Relation) -> list[Expr]:
    left = _sides(said.left) if isinstance(said.left, Relation) else [said.left]
    return [*left, said.right]


def _pairs(said: Relation) -> Iterator[Pair]:
    """Both ways round, without units."""
    left = said.left
    if isinstance(left, Relation):
        yield from _pairs(left)
        left = left.right
    one, other = (side.value if isinstance(side, Measured) else side for side in (left, said.right))
    yield min((one, said.sign, other), (other, TURNED.get(said.sign, said.sign), one), key=repr)


def _values(tree: Any) -> list[float]:
    value = float(tree.value)
    return [value, radians(value)] if isinstance(tree, Degrees) else [value]
