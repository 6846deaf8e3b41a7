"""A problem while its questions are answered: what is given, and what has been derived already."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Literal, get_args

from derive.algebra.bounds import count, one_answer
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import Names, normal, normal_matrix
from derive.algebra.rationals import significant_digits
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.terms import Style
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation
from derive.expression import PI, Degrees, Expr, Indexed, Matrix, Number, Symbol, every, free_symbols, walk
from derive.kinds.declared import with_all_claims
from derive.kinds.registry import load
from derive.kinds.told import with_results_told
from derive.kinds.units import units_of
from derive.names import require_free

TREES = get_args(Expr)
NAMES = (Symbol, Indexed)


@dataclass(frozen=True, slots=True)
class Memo:
    """What has been found about a problem so far, so that nothing is found twice."""

    answers: dict[tuple[str, Any], Derivation] = field(default_factory=dict)  # by kind and options
    written: dict[Hashable, Expr] = field(default_factory=dict)  # readable forms, by the keys of normal forms
    values: dict[Expr, ScalarMatrix] = field(default_factory=dict)  # of matrices that were made readable
    seen: dict[Hashable, Any] = field(default_factory=dict)  # by second routes at a point
    terms: Counter[Hashable] = field(default_factory=Counter)  # written out so far, ring by ring


@dataclass(frozen=True)
class Problem:
    """One subject and the derivations about it. `where` are names kept while working and replaced
    at the end; `assumptions` say what is known of a name ("positive", ...)."""

    name: str  # of the subject: "robot", "motion", ...
    subject: Any
    where: Mapping[str, Expr] = field(default_factory=dict)
    assumptions: Mapping[str, str] = field(default_factory=dict)
    questions: tuple[tuple[str, Any], ...] = ()  # kind and options of all that is asked about the subject
    angles: Literal["deg", "rad"] | None = None  # as the sheet wants them; None: as they were typed
    points: tuple[Expr, ...] = ()  # values at which answers are evaluated
    memo: Memo = field(default_factory=Memo)
    order: tuple[str, ...] = ()  # of angles, where it is not that of the sheet

    def ask(self, kind: str, /, **options: Any) -> Derivation:
        """The derivation of a question about this subject, made once however often it is asked.

        Raises NotDerivable where the answer is beyond this program.
        """
        module = load(self.name, kind)
        return self.answer(kind, module.Options(**options))

    def answer(self, kind: str, options: Any) -> Derivation:
        """The same with the options as the kind's own model."""
        key = (kind, options)
        if key not in self.memo.answers:
            module = load(self.name, kind)
            with one_answer():
                derivation = module.derive(self.subject, options, self)
            self.require_own(derivation.definitions)
            complete = with_all_claims(derivation, module, self.subject, options)
            units = units_of(complete, module, self.subject, self.style.units)
            styled = replace(complete.facts, style=self.style)
            told = with_results_told(complete, module, self.names, units, styled)
            self.memo.answers[key] = told
        return self.memo.answers[key]

    def require_own(self, names: Iterable[Expr]) -> None:
        """Raises NotDerivable where the author means something else by one of the names of an answer."""
        own = (name.name for name in names if isinstance(name, Symbol))
        require_free(self.symbols - getattr(self.subject, "defines", frozenset()), *own)

    @cached_property
    def taken(self) -> frozenset[str]:
        """Every name that means something on the sheet; an answer calls nothing else so."""
        return self.symbols | self.where.keys()

    @cached_property
    def symbols(self) -> frozenset[str]:
        """Every name the answer can depend on; those of `where` stand for others and are left out."""
        trees = [*expressions(self.subject), *self.where.values()]
        return frozenset().union(*map(free_symbols, trees)) - set(self.where)

    @cached_property
    def moving(self) -> frozenset[str]:
        """The names that stand for what lies on both sides of zero: joint variables and coordinates; of
        motions and frames every one that its author does not say is positive."""
        if self.name in ("motion", "frames"):
            return self.symbols - self.assumptions.keys()
        return frozenset(getattr(self.subject, "variables", getattr(self.subject, "coordinates", ())))

    # -- from trees to normal forms and back ------------------------------------------------------

    @cached_property
    def names(self) -> Names:
        """`where` as definitions."""
        return {Symbol(name): value for name, value in self.where.items()}

    @cached_property
    def style(self) -> Style:
        """Decimals and degrees where the author typed them; joint variables and coordinates in their order,
        then other names as they are met on the sheet."""
        trees = [node for tree in expressions(self.subject) for node in walk(tree)]
        trees += [node for tree in self.where.values() for node in walk(tree)]
        typed = [node for node in trees if isinstance(node, Number)]
        met = (node.name for node in trees if isinstance(node, Symbol) and node != PI)
        return Style(
            decimals=any(node.decimal for node in typed),
            degrees=self.angles == "deg" if self.angles else any(isinstance(node, Degrees) for node in trees),
            units=any(node.unit for node in typed),
            turned=any(isinstance(node, Degrees) for tree in self._asked() for node in walk(tree)),
            longest=max((significant_digits(node.value) or 0 for node in typed if node.decimal), default=0),
            letters=getattr(self.subject, "letters", ()),
            order=self.order or tuple(dict.fromkeys((*getattr(self.subject, "variables", ()), *met))),
        )

    def ordered(self, angles: tuple[str, ...]) -> Problem:
        """The same with angles in the order of a product that makes its rotation."""
        memo = replace(self.memo, written={}, values={})
        return replace(self, order=angles, memo=memo)

    def _asked(self) -> Iterator[Expr]:
        """The formulas in what is asked, and the points."""
        yield from self.points
        for _, options in self.questions:
            yield from (tree for _, value in options for tree in expressions(value))

    def readable(self, value: Scalar) -> Expr:
        """As a person would write it, names of `where` kept; the same value is read once."""
        key = value.key()
        if key not in self.memo.written:
            self.memo.terms[value.ring] += len(value.numerator)
            count(len(value.numerator), self.memo.terms.total())
            self.memo.written[key] = readable(value, self.style)
        return self.memo.written[key]

    def readable_matrix(self, value: ScalarMatrix) -> Matrix:
        """As a person would write it, entry by entry."""
        found = Matrix(tuple(tuple(map(self.readable, row)) for row in value.rows))
        self.memo.values[found] = value
        return found

    def normal_matrix(self, expr: Expr) -> ScalarMatrix:
        """The normal form of a tree; of one that was made readable here, that which it was made of."""
        value = self.memo.values.get(expr)
        return normal_matrix(expr) if value is None else value

    def exact(self, value: ScalarMatrix) -> ScalarMatrix:
        """A matrix with the names of `where` replaced."""
        return normal_matrix(self.readable_matrix(value), self.names)

    def final(self, expr: Expr, names: Names | None = None) -> Expr:
        """A scalar or a matrix with `where` (and `names`) replaced by their values; the same tree
        where nothing is to be replaced."""
        known = {**self.names, **(names or {})}
        if not known or not any(isinstance(node, NAMES) and node in known for node in walk(expr)):
            return expr
        if isinstance(expr, Matrix):
            return readable_matrix(normal_matrix(expr, known), self.style)
        return readable(normal(expr, known), self.style)


def expressions(value: Any) -> Iterator[Expr]:
    """Every tree inside a frozen subject."""
    return (part for part in every(value) if isinstance(part, TREES))
