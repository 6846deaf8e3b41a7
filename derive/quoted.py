"""What a sentence says in mathematics it quotes: from a line, a name, a result, a table, or the sheet.

A formula within a sentence is part of no chain, so no link between lines holds it. It is looked for, as a
whole or as a part, in what is verified elsewhere. An equation may be true by what its names mean instead.
Formulas that are said in sentences alone (`OWN`) are left to the claims of their kinds.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from math import isclose, radians
from typing import Any, get_args

from pydantic import BaseModel

from derive.derivation import Derivation, Phrase
from derive.expression import (
    ONE,
    ZERO,
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
    between,
    children,
    free_symbols,
    number,
    replace,
    walk,
)
from derive.given.datum import Datum
from derive.kinds.problem import Problem
from derive.kinds.somewhere import Somewhere, contradicted, values_of
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.robot import Robot

OWN: Mapping[str, str] = {  # fields of phrases which claims of their kinds hold
    "advances": "turn", "again": "times", "all-turn": "passing", "annulus-alone": "far near",
    "annulus-too": "far inner near", "axes-of-turns": "turn", "axis": "letter", "beside": "angle",
    "bounds-met": "chain", "circle-alone": "far near", "circle-too": "far inner near",
    "cone-of-approaches": "cosines", "cone-of-directions": "cosines", "converged": "bound error",
    "coupled-rows": "passing", "cubic-greatest": "half", "cubic-law": "share",
    "cycloidal-greatest": "early half late", "cycloidal-law": "share", "definite-just-where": "conditions",
    "disc-alone": "far near", "disc-and": "far inner near", "disc-if-any": "far inner outer",
    "disc-without-ring": "far inner outer", "either-or": "need opposite", "error-below": "bound",
    "follows": "chain equation", "forwards": "ahead", "free-row": "frame before",
    "free-row-one": "frame before", "goes-evenly": "when", "goes-on": "end", "gradient-goes-on": "share",
    "gradient-stopped-at-once": "bound", "greater-if": "when", "if": "when", "input-jumps": "start",
    "just-room": "area", "kept-where": "conditions", "last-link-anywhere": "far",
    "last-link-within": "far gap inside", "last-of": "equation", "least-rates": "plus", "leaves-range": "t",
    "leg-folded": "leg", "leg-stretched": "leg", "longer-if": "when", "minors": "det",
    "negative-at": "minor", "newton-stopped-at-once": "bound", "no-room": "area", "not-yet": "bound",
    "outer-axes-too": "middle", "overshoot-at": "time", "pair": "imaginary real", "pitch": "turn",
    "plateau": "area", "possible-acceleration": "least", "possible-velocity": "least most",
    "put-back": "off", "quartic-there": "quartic", "quartic-without-roots": "quartic",
    "quintic-greatest": "early half late", "quintic-law": "share", "quintic-peaks": "early late",
    "ramps": "ramp", "rise": "ends", "room": "area", "seen-block": "block input", "seen-sum": "input",
    "settles": "origin", "slower": "square", "slows-down": "when", "speeds-up": "when",
    "square-follows": "chain", "still-row": "frame before", "still-row-one": "frame before",
    "takes": "freedoms", "the-base": "far near", "then-about-current": "product",
    "then-along-world": "product", "together-named": "names", "too-little-turn": "turn", "tracks": "origin",
    "turn-or-advance": "passing", "turn-or-slide": "passing", "turns": "turn", "uneven-ellipse": "ratio",
    "where": "need", "where-not-negative": "condition", "with-unit": "name",
}  # fmt: skip
WORKED_OUT = ("home", "observed", "observed-one", "screws", "stewart")  # tables and equations
TREES = get_args(Expr)
NUMBERS = (Number, Approximate, Degrees)
NAMES = (Symbol, Indexed)
Formula = Expr | Relation
Pair = tuple[Expr, str, Expr]
PLAIN = (ZERO, ONE)  # entries of any matrix
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<="}


def unquoted(answer: Derivation, options: Any, problem: Problem) -> Iterator[str]:
    """The fields of phrases, as `key.field`, that hold a formula which stands nowhere else."""
    told = [*_rested_on(answer)]
    checked: dict[int, Derivation] = problem.memo.seen.setdefault("quoted", {})
    new = [each for each in told if id(each) not in checked]
    checked.update((id(each), each) for each in new)
    phrases = _phrases([(each.facts, each.plots, *(step.facts for step in each.all_steps())) for each in new])
    board = Board((options, problem.where, problem.points), problem.subject, told)
    yield from board.strange(phrases)


def misgiven(data: Iterable[Datum], options: Any, problem: Problem) -> Iterator[str]:
    """The same of what the page says that a problem gives, or a question: by its table and equations too."""
    taken = gravity_of(problem.subject) if isinstance(problem.subject, Robot) else ()
    board = Board((options, problem.where, problem.points, taken), problem.subject, [])
    for datum in data:
        yield from board.strange(_phrases(datum))
        rows = datum.table.rows if datum.table else ()
        if datum.said.key not in WORKED_OUT and not all(
            map(board.says, _formulas(tuple(_mathematics((rows, datum.equations)))))
        ):
            yield datum.said.key


def _rested_on(answer: Derivation) -> Iterator[Derivation]:
    yield answer
    for used in answer.uses:
        yield from _rested_on(used)


def _phrases(value: Any) -> Iterator[Phrase]:
    match value:
        case Phrase(about=about):
            yield value
            yield from _phrases(tuple(about.values()))
        case tuple() | list():
            for each in value:
                yield from _phrases(each)
        case Mapping():
            yield from _phrases(tuple(value.values()))
        case _ if is_dataclass(value) and not isinstance(value, (type, Relation, *TREES)):
            for each in fields(value):
                yield from _phrases(getattr(value, each.name))


def _formulas(said: Any) -> Iterator[Formula]:
    """Those of a field, joint variables without the star that tables give them."""
    match said:
        case tuple():
            for each in said:
                yield from _formulas(each)
        case Relation():
            yield said
        case _ if isinstance(said, TREES) and not isinstance(said, NAMES):
            stars: dict[Expr, Expr] = {
                Symbol(name): Symbol(name[:-1]) for name in free_symbols(said) if name.endswith("*")
            }
            yield replace(said, stars)


@dataclass
class Board:
    """All that is verified elsewhere: what the sheet has, and what answers say outside of sentences."""

    typed: Any
    subject: Any
    answers: list[Derivation]
    trees: list[Expr] = field(default_factory=list)
    relations: set[Pair] = field(default_factory=set)
    at: Somewhere = field(init=False)

    def __post_init__(self) -> None:
        """Names and formulas are gathered once."""
        names: dict[Expr, Expr] = {}
        for each in self.answers:
            names |= each.definitions
        self.at = Somewhere(names)
        ranges = getattr(self.subject, "ranges", {})
        within = [between(low, Symbol(name), high) for name, (low, high) in ranges.items()]
        for part in (self.typed, self.subject, within, *map(_outside, self.answers)):
            for found in _mathematics(part):
                if isinstance(found, Relation):
                    self.relations |= {*_pairs(found)}
                    self.trees += _sides(found)
                else:
                    self.trees.append(found)

    def strange(self, phrases: Iterable[Phrase]) -> Iterator[str]:
        """The fields with a formula that this does not say."""
        for phrase in phrases:
            for name, said in phrase.about.items():
                own = name in OWN.get(phrase.key, "").split()
                if not own and not all(map(self.says, _formulas(said))):
                    yield f"{phrase.key}.{name}"

    def says(self, formula: Formula) -> bool:
        """Whether it stands here, or is true."""
        if not isinstance(formula, Relation):
            return self._has(formula)
        pairs = {*_pairs(formula)}
        if pairs <= self.relations:
            return True
        return all(sign == "=" for _, sign, _ in pairs) and self._equal(_sides(formula))

    def _equal(self, sides: list[Expr]) -> bool:
        """What is true by what names mean, or says of a thing what is said elsewhere."""
        values = [*values_of(sides, self.at)]
        true = len(values) == len(sides) and not contradicted(sides, self.at)
        return true or all(map(self._has, sides))

    def _has(self, tree: Expr) -> bool:
        if isinstance(tree, Measured):
            return self._has(tree.value)
        if isinstance(tree, NAMES):
            return True
        if isinstance(tree, NUMBERS):
            return self._has_number(tree)
        kind, size = type(tree), len(children(tree))
        whole = any(
            type(node) is kind and len(children(node)) == size and node == tree
            for each in self.trees
            for node in walk(each)
        )
        return whole or (
            _is_vector(tree) and all(entry in PLAIN or self._has(entry) for entry in children(tree))
        )

    def _has_number(self, tree: Any) -> bool:
        wanted = _values(tree)
        nodes = (node for each in self.trees for node in walk(each) if isinstance(node, NUMBERS))
        return any(isclose(a, b, rel_tol=1e-12) for node in nodes for a in _values(node) for b in wanted)


def _is_vector(tree: Expr) -> bool:
    """Or a matrix, which may be put together of what is typed one by one."""
    return isinstance(tree, Matrix) or (isinstance(tree, Call) and tree.function == "diag")


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
        case Mapping():
            for pair in value.items():
                yield from _mathematics(pair)
        case BaseModel():
            for pair in value:
                yield from _mathematics(pair)
        case _ if is_dataclass(value) and not isinstance(value, type):
            for each in fields(value):
                yield from _mathematics(getattr(value, each.name))
        case _ if isinstance(value, Iterable) and not isinstance(value, str):
            for each in value:
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
