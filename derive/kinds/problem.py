"""A problem while its questions are answered: what is given, and what has been derived already."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, fields, is_dataclass
from functools import cached_property
from typing import Any, get_args

from derive.algebra.bounds import count, one_answer
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import NAMESAKE, Names, normal, normal_matrix
from derive.algebra.readable.form import readable, readable_matrix
from derive.algebra.readable.terms import Style
from derive.algebra.readable.writing import opposite
from derive.algebra.scalar import Scalar
from derive.control.system import System
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Degrees, Expr, Indexed, Matrix, Number, Symbol, free_symbols, walk
from derive.kinds.registry import load

TREES = get_args(Expr)
NAMES = (Symbol, Indexed)
LONG = 10  # terms


@dataclass(frozen=True)
class Problem:
    """One subject and the derivations about it. `where` are names kept while working and replaced
    at the end; `assumptions` say what is known of a name ("positive", ...)."""

    name: str  # of the subject: "robot", "motion", ...
    subject: Any
    where: Mapping[str, Expr] = field(default_factory=dict)
    assumptions: Mapping[str, str] = field(default_factory=dict)
    derived: dict[tuple[str, Any], Derivation] = field(default_factory=dict)
    written: dict[Hashable, Expr] = field(default_factory=dict)
    values: dict[int, tuple[Expr, ScalarMatrix]] = field(default_factory=dict)
    terms: Counter[Hashable] = field(default_factory=Counter)  # written out so far
    questions: tuple[tuple[str, Any], ...] = ()  # kind and options of all that is asked about the subject

    def ask(self, kind: str, /, **options: Any) -> Derivation:
        """The derivation of a question about this subject, made once however often it is asked.

        Raises NotDerivable where the answer is beyond this program.
        """
        module = load(self.name, kind)
        return self.answer(kind, module.Options(**options))

    def answer(self, kind: str, options: Any) -> Derivation:
        """The same with the options as the kind's own model."""
        key = (kind, options)
        if key not in self.derived:
            try:
                with one_answer():
                    derivation = load(self.name, kind).derive(self.subject, options, self)
            except RecursionError as error:
                raise NotDerivable(
                    "a formula of this problem is nested too deeply, with the values of its names put in"
                ) from error
            self.derived[key] = self._distinct(derivation)
        return self.derived[key]

    def _distinct(self, derivation: Derivation) -> Derivation:
        """The derivation, unless one of its names means something else on the sheet."""
        if isinstance(self.subject, System):  # its equations define the author's own names
            return derivation
        own = {name.name for name in derivation.definitions if isinstance(name, Symbol)}
        taken = sorted(own & self.symbols)
        if taken:
            raise NotDerivable(NAMESAKE.format(taken[0]))
        return derivation

    @cached_property
    def symbols(self) -> frozenset[str]:
        """Every name the answer can depend on; those of `where` stand for others and are left out."""
        trees = [*expressions(self.subject), *self.where.values()]
        return frozenset().union(*map(free_symbols, trees)) - set(self.where)

    # -- from trees to normal forms and back ------------------------------------------------------

    @cached_property
    def names(self) -> Names:
        """`where` as definitions."""
        return {Symbol(name): value for name, value in self.where.items()}

    @cached_property
    def style(self) -> Style:
        """Decimals and degrees where the author typed them; joint variables in their order."""
        trees = [node for tree in expressions(self.subject) for node in walk(tree)]
        trees += [node for tree in self.where.values() for node in walk(tree)]
        return Style(
            decimals=any(isinstance(node, Number) and node.decimal for node in trees),
            degrees=any(isinstance(node, Degrees) for node in trees),
            order=getattr(self.subject, "variables", ()),
        )

    def angular(self, names: Iterable[str]) -> dict[str, Any]:
        """What a page needs to know to print these results in degrees where the author typed degrees."""
        return {"angle_results": tuple(names), "style": self.style}

    def readable(self, value: Scalar) -> Expr:
        """As a person would write it, names of `where` kept; the same value is read once."""
        key = value.key()
        if key not in self.written:
            self.terms[value.ring] += len(value.numerator)
            count(len(value.numerator), self.terms.total())
            self.written[key] = self._read(value)
        return self.written[key]

    def _read(self, value: Scalar) -> Expr:
        """A long one whose opposite is written already is not searched for again."""
        if len(value.numerator) > LONG:
            known = self.written.get((-value).key())
            if known is not None:
                return opposite(known)
        return readable(value, self.style)

    def readable_matrix(self, value: ScalarMatrix) -> Matrix:
        found = Matrix(tuple(tuple(map(self.readable, row)) for row in value.rows))
        self.values[id(found)] = found, value
        return found

    def normal_matrix(self, expr: Expr) -> ScalarMatrix:
        """The normal form of a tree; of one that was made readable here, that which it was made of."""
        _, value = self.values.get(id(expr), (None, None))
        return normal_matrix(expr) if value is None else value

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
    return (part for part in parts(value) if isinstance(part, TREES))


def parts(value: Any) -> Iterator[Any]:
    """Every value inside a frozen subject, trees whole."""
    yield value
    if isinstance(value, tuple):
        for part in value:
            yield from parts(part)
    elif is_dataclass(value) and not isinstance(value, TREES):
        for each in fields(value):
            yield from parts(getattr(value, each.name))
