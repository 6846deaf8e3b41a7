"""The board of one answer: what is given, the lines worked out from it, and what is claimed about them.

A formula is written once. `line` puts it on the board; its value is computed from it by the normal form and
written down by the readable form, so that nothing is narrated afterwards. Big matrices are computed by matrix
arithmetic and handed to `line` as its `value`; the link from the formula to that value is then what is
verified. Every method gives a new board.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, walk_over
from derive.algebra.numbers.floats import Point, completed, numbers, scalar_number
from derive.algebra.scalar import Scalar
from derive.algebra.signs import sign_of
from derive.algebra.values import Value, matrix_of
from derive.derivation import Claim, Derivation, PageFacts, Phrase, Record, Result, Said, Step, as_matrix
from derive.errors import FormulaError, NotDerivable
from derive.expression import Degrees, Expr, Indexed, Matrix, Measured, Symbol, free_symbols
from derive.expression import replace as put_in
from derive.kinds.chains import closing, constants_together, distinct, piled, with_units
from derive.kinds.checks import TOLERANCE, agreement, law
from derive.kinds.links import UNLINKED, links
from derive.kinds.problem import Problem
from derive.names import NAMESAKE, named

CLOSE = 1e-12
Name = Symbol | Indexed


@dataclass(frozen=True, slots=True)
class Work:
    """What stands on the board.

    `known` are names of the page and what they stand for, the same name for a quantity that its author calls
    so; `aside` are names that chains may hold and no page defines. `uses` are the derivations this one rests
    on. `angular` writes multiples of pi in degrees, as the author typed them. An answer whose name is `taken`
    by the author gets a `_p` on the page. Numbers that are put in for names have the `units` of these.
    """

    problem: Problem
    known: Mapping[Expr, Expr] = field(default_factory=dict)
    angular: bool = False
    taken: frozenset[str] = frozenset()
    units: Mapping[Expr | Phrase, str] = field(default_factory=dict)
    aside: Mapping[Expr, Expr] = field(default_factory=dict)
    uses: tuple[Derivation, ...] = ()
    steps: tuple[Step, ...] = ()
    claims: tuple[Claim, ...] = ()
    checked: bool = False  # whether the chains are among the claims
    values: Mapping[Expr, Value] = field(default_factory=dict)  # normal forms of names, as they were computed

    # -- what stands there ------------------------------------------------------------------------

    def __getitem__(self, name: str | Name) -> Expr:
        """What a name stands for. Raises KeyError."""
        return self.known[self.symbol(name) if isinstance(name, str) else name]

    def matrix(self, name: str | Name) -> Matrix:
        """What stands for a name that is one of a matrix. Raises TypeError for any other."""
        return as_matrix(self[name], str(name))

    def entries(self, name: str | Name) -> tuple[Expr, ...]:
        """Those of a matrix, row by row."""
        return tuple(entry for row in self.matrix(name).rows for entry in row)

    @property
    def definitions(self) -> dict[Expr, Expr]:
        """What every name stands for, that of a symbol of the sheet left out."""
        return {name: value for name, value in self.known.items() if name != value}

    @property
    def typed(self) -> tuple[tuple[Expr, Expr], ...]:
        """Names that stand for something the author typed, as chains; those worked out are left out."""
        worked = {self.symbol(step.name) for step in self.steps}
        return tuple((name, value) for name, value in self.definitions.items() if name not in worked)

    def symbol(self, name: str) -> Symbol:
        """What an answer is called on the page."""
        return Symbol(f"{name}_p" if name in self.taken else name)

    def value(self, expr: Expr) -> Value:
        """The normal form of a formula in the names of the board, names of `where` kept."""
        value = self.values.get(expr)
        if value is None:
            names = {**self.aside, **self.definitions}
            return walk_over([expr], names, self.values).value(expr)
        return value

    def value_matrix(self, expr: Expr) -> ScalarMatrix:
        """The normal form of a formula that is a matrix; one entry where it is a scalar."""
        return matrix_of(self.value(expr))

    def scalar(self, expr: Expr) -> Scalar:
        """The normal form in the symbols of the sheet, those of `where` replaced."""
        return normal(expr, {**self.problem.names, **self.aside, **self.definitions})

    def final(self, name: str | Name) -> Expr:
        """The value of a line with everything replaced."""
        return self.problem.final(self[name])

    def sign(self, expr: Expr) -> int | None:
        """1, 0 or -1; None where symbols leave it open."""
        value = self.scalar(expr)
        positive = (name for name, what in self.problem.assumptions.items() if what == "positive")
        if (known := sign_of(value, frozenset(positive))) is not None:
            return known
        try:
            number = scalar_number(value, {})
        except (KeyError, ValueError, ZeroDivisionError):
            return None
        return 0 if abs(number) < CLOSE else 1 if number > 0 else -1

    # -- what is put there ------------------------------------------------------------------------

    def resting_on(self, *used: Derivation) -> Work:
        """With derivations this one rests on, and the names they define."""
        names = {name: value for each in used for name, value in each.definitions.items()}
        return replace(self, uses=(*self.uses, *used), known={**self.known, **names})

    def knowing(self, names: Mapping[Expr, Expr]) -> Work:
        """With more quantities that are given and need no step of their own."""
        values = {name: value for name, value in self.values.items() if name not in names}
        return replace(self, known={**self.known, **names}, values=values)

    def naming(self, **usual: Expr) -> tuple[Work, tuple[Symbol, ...]]:
        """With quantities that are given, each by the name its author uses, else by the usual one; and these
        names in the same order."""
        names = tuple(named(name, value, self.problem.taken) for name, value in usual.items())
        return self.knowing(dict[Expr, Expr](zip(names, usual.values(), strict=True))), names

    def given(self, name: Symbol, value: Value | Expr, rule: str = "given") -> Work:
        """A quantity that is given, as a step."""
        return self.line(name, value=value, rule=rule)

    def step(self, *steps: Step) -> Work:
        """Steps that were made elsewhere; the symbol at the head of each stands for its result, but that of a
        law for nothing."""
        chains = (each.chain for each in steps if each.chain and each.rule not in UNLINKED)
        names: dict[Expr, Expr] = {chain[0]: chain[-1] for chain in chains if isinstance(chain[0], Symbol)}
        return replace(self, steps=(*self.steps, *steps), known={**self.known, **names})

    def showing(self, *steps: Step) -> Work:
        """Steps that were made elsewhere and whose names stand for nothing in other chains."""
        return replace(self, steps=(*self.steps, *steps))

    def line(
        self,
        name: str | Expr,
        *formulas: Expr,
        value: Value | Expr | None = None,
        rule: str = "",
        facts: Record | None = None,
        steps: tuple[Step, ...] = (),
        label: str = "",
        spare: tuple[Expr, ...] = (),
        entries: Mapping[tuple[int, int], Symbol] | None = None,
        instance: Mapping[Expr, Expr] | None = None,
    ) -> Work:
        """A line more, `name = formula = formula = value`: the value of the first formula, or one that was
        computed in another way, which the chain is then checked against. The words know the step by its
        `label`, or else by the name. What has the value may be no name but a formula, as det(J), which no
        other need follow; it needs a label. `spare` and `entries` are those of the step. With an
        `instance` the line is a law: its names are none of the board, and stand for these in a case."""
        head = self.symbol(name) if isinstance(name, str) else name
        if instance is not None:
            law_of = Step(
                label or text(head), (head, *formulas), "law", facts or Record(), steps, instance=instance
            )
            return replace(self, steps=(*self.steps, law_of))
        found = self.value(formulas[0] if formulas else head) if value is None else value
        exact: dict[Expr, Value] = {head: found} if isinstance(found, Scalar | ScalarMatrix) else {}
        written = self.readable(found) if isinstance(found, Scalar | ScalarMatrix) else found
        named: dict[Expr, Expr] = {head: written} if isinstance(head, Symbol) else {}
        step = Step(
            label or text(head), distinct((head, *formulas, written)), rule, facts or Record(), steps, spare,
            entries or {},
        )  # fmt: skip
        return replace(
            self,
            steps=(*self.steps, step),
            known={**self.known, **named},
            values={**self.values, **exact},
        )

    def worked(self, name: str, formula: Expr, answer: Expr | None = None, rule: str = "") -> Work:
        """A line more, `name = formula = numbers put in = what comes out`; `answer` is that where it is to be
        written in a certain way. A quantity that is given makes no line. Raises NotDerivable where the author
        means something else by the name."""
        symbol = self.symbol(name)
        if formula == symbol:
            return self
        if self.known.get(symbol) == symbol:
            raise NotDerivable(NAMESAKE.format(symbol.name))
        filled = constants_together(put_in(formula, self.definitions))
        if answer is None:  # a formula in the author's own symbols stays as books print it
            answer = formula if filled == formula else self.shown(formula)
        if self.units:
            filled = put_in(formula, with_units(self.definitions, self.units))
        plain = isinstance(filled, Measured) or free_symbols(filled) or piled(filled)
        step = Step(name, distinct((symbol, formula, *(() if plain else (filled,)), answer)), rule)
        return replace(self, steps=(*self.steps, step), known={**self.known, symbol: answer})

    def closed(self, *names: str | Expr, spare: bool = False) -> Work:
        """The lines of these names ended by their values with the names of `where` replaced; lines after them
        start from there. These are left out where they are too long and `spare`."""
        heads = {self.symbol(name) if isinstance(name, str) else name for name in names}
        lines = {step.chain[0]: step.result for step in self.steps if step.chain}
        ends = {head: self.problem.final({**lines, **self.known}[head]) for head in heads}
        steps = (
            closing(s, ends[s.chain[0]], spare) if s.chain and s.chain[0] in ends else s for s in self.steps
        )
        values = {name: value for name, value in self.values.items() if name not in ends}
        known = {name: ends.get(name, value) for name, value in self.known.items()}
        return replace(self, steps=tuple(steps), known=known, values=values)

    # -- how it is written ------------------------------------------------------------------------

    def readable(self, value: Value) -> Expr:
        """A normal form as a person writes it; an angle in degrees where the author did."""
        if isinstance(value, ScalarMatrix):
            return self.problem.readable_matrix(value)
        if self.angular:
            turns = (value / Scalar.symbol("pi")).constant
            if turns is not None and value.constant is None:
                return Degrees(turns * 180)
        return self.problem.readable(value)

    def shown(self, expr: Expr) -> Expr:
        """What a formula comes to, names of `where` kept; as it stands, with what is known put in, where that
        cannot be read back, as 2^b of a symbol."""
        try:
            return self.readable(normal(expr, self.definitions))
        except FormulaError:
            return put_in(expr, self.definitions)

    # -- what is claimed of it --------------------------------------------------------------------

    def law(self, claim: str, holds: bool | Iterable[bool], **about: Said) -> Work:
        """What the answer must obey, decided by normal form, of each of several things."""
        return self.claim(law(claim, holds, **about))

    def agrees(
        self,
        claim: str,
        symbols: Iterable[str],
        ours: Value | Expr | Callable[[Point], Any],
        other: Callable[[Point], Any],
        tolerance: float = TOLERANCE,
        points: int = 3,
        **about: Said,
    ) -> Work:
        """The same numbers by a route that shares nothing with the lines of this board, at points with the
        values of `where` added; `ours` is a value in the symbols of the sheet, or how its numbers are had."""
        where = self.problem.where
        route: Callable[[Point], Any] = ours if callable(ours) else partial(numbers, ours)
        mine, another = (lambda at, of=each: of(completed(at, where)) for each in (route, other))
        moving = self.problem.moving
        return self.claim(agreement(claim, symbols, mine, another, tolerance, points, moving, **about))

    def claim(self, *claims: Claim) -> Work:
        """With claims that were made elsewhere."""
        return replace(self, claims=(*self.claims, *claims))

    def linked(self, but: Iterable[str] = ()) -> Work:
        """With the claim that each chain so far is equal from end to end, but for the steps named in `but`.

        `answer` makes this claim of all chains, first of all, where no one has made it before. Lines that are
        put there after it are in no link: for these a kind needs a law or a route, and a reason.
        """
        steps = [step for step in self.steps if step.name not in {*but}]
        names = {**self.problem.names, **self.aside, **self.definitions}
        found = links(steps, names, self.problem.symbols)
        return replace(self, claims=(*self.claims, *found), checked=True)

    def answer(
        self, kind: str, results: Mapping[str, Result], facts: PageFacts | None = None, **others: Any
    ) -> Derivation:
        """The derivation that stands on the board. `others` are further fields of it. Raises NotDerivable
        where one of its names means something else to the author."""
        if not self.checked:
            self.problem.require_own(self.definitions)
            whole = replace(self, claims=()).linked()
            return replace(whole, claims=(*whole.claims, *self.claims)).answer(kind, results, facts, **others)
        return Derivation(
            kind,
            self.steps,
            results,
            self.claims,
            self.definitions,
            uses=self.uses,
            facts=facts or PageFacts(),
            **others,
        )
