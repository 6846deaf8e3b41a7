"""The board on which an inverse is written: the names given so far, the signs chosen, the moves made."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from derive.algebra.angles import Form, combination
from derive.algebra.infix import text
from derive.algebra.normal import normal, trig_of
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Call, Expr, Symbol, free_symbols, negate
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.moves import Definition, Item, Move, Option
from derive.kinds.robot._inverse.trees import leaves, minus, ordered, starts_negative, unsigned
from derive.mechanics.inverse.goal import Goal

LONG = 3  # names and numbers in an expression; a longer one gets a name of its own


class Board:
    """What stands on the board. `turning` are the revolute joints in order."""

    def __init__(
        self, problem: Problem, goal: Goal, turning: Sequence[str], free_name: Callable[[str], str]
    ) -> None:
        self.problem, self.goal, self.turning = problem, goal, tuple(turning)
        self.free_name = free_name
        self.items: list[Item] = []
        self.named: list[tuple[Symbol, Scalar]] = []
        self.signs: dict[str, int] = {}  # generator -> the move whose sign it has
        self.sums: list[tuple[Scalar, int]] = []  # likewise of sums
        self.forms: list[Form] = []
        self.steps = 0

    # -- names ------------------------------------------------------------------------------------

    def define(self, name: str, value: Scalar) -> Symbol:
        """A name for a known quantity."""
        symbol = Symbol(name)
        self.named.append((symbol, value))
        self.items.append(Definition(symbol, self.tree(value)))
        return symbol

    def value_of(self, symbol: Symbol) -> Expr:
        """What a name stands for."""
        return next(i.value for i in self.items if isinstance(i, Definition) and i.name == symbol)

    def next_name(self) -> str:
        """k_1, k_2, ..."""
        count = sum(1 for item in self.items if isinstance(item, Definition) and item.name.name[:2] == "k_")
        return self.free_name(f"k_{count + 1}")

    def tree(self, value: Scalar) -> Expr:
        """As a person writes it, what is subtracted last."""
        return ordered(self.problem.readable(value))

    def known_as(self, value: Scalar) -> Expr | None:
        """The value as it is where it is short, or by a name it has already; None for any other."""
        tree = self.tree(value)
        if leaves(tree) <= LONG:
            return tree
        for symbol, known in self.named:
            if known == value:
                return symbol
            if known == -value:
                return negate(symbol)
        return None

    def minuses(self, *values: Scalar) -> int:
        """How many minus signs these are written with; the first ones weigh more, and those in front."""
        written = [text(self.known_as(value) or self.tree(value)) for value in values]
        signs = [each.count("-") + each.startswith("-") for each in written]
        return sum(2 ** (len(signs) - place) * count for place, count in enumerate(signs))

    def may_vanish(self, *trees: Expr) -> list[Expr]:
        """Those of these that rest on the pose, each once and without its sign: a length does not vanish."""
        lengths = self.problem.symbols - set(self.problem.subject.variables)
        found = dict.fromkeys(unsigned(tree) for tree in trees if not free_symbols(tree) <= lengths)
        return list(found)

    def angle(self, form: Form) -> Expr:
        """theta2 + theta3 as it is printed in its cosine."""
        total = Scalar.of(0)
        for atom, n in form.parts:
            total = total + Scalar.symbol(atom) * n
        tree = self.problem.readable(trig_of(total)[0])
        angle = tree.arguments[0] if isinstance(tree, Call) else tree
        return minus(angle) if normal(angle) == -total else angle  # a cosine is the same of both

    # -- moves ------------------------------------------------------------------------------------

    @property
    def moves(self) -> list[Move]:
        return [item for item in self.items if isinstance(item, Move)]

    def shown(self, chain: tuple[Expr, ...]) -> bool:
        """Whether an earlier move has this very equation."""
        return any(step.chain == chain for move in self.moves for step in move.steps)

    def determined(self) -> list[str]:
        """The joints that the sums found so far determine."""
        return [j for j in self.turning if combination(Form.of({j: 1}), self.forms) is not None]

    def sign_of(self, value: Scalar) -> tuple[int, tuple[int, ...]]:
        """The sign of a term or of a sum, and the moves whose signs it has as factors; 0 where it is not
        known."""
        for known, move in self.sums:
            if value and (ratio := (value / known).constant) is not None:
                return (1 if ratio > 0 else -1), (move,)
        terms = list(value.numerator.terms())
        if len(terms) != 1 or value.denominator is not None:
            return 0, ()
        exponents, coefficient = terms[0]
        odd = [name for name, power in zip(value.ring.names, exponents, strict=True) if power % 2]
        open_ones = [name for name in odd if not name.startswith("sqrt(") and not self._positive(name)]
        if any(name not in self.signs for name in open_ones):
            return 0, ()
        return (1 if coefficient > 0 else -1), tuple(self.signs[name] for name in open_ones)

    def _positive(self, name: str) -> bool:
        return self.problem.assumptions.get(name) == "positive"


class Draft:
    """One move while it is written."""

    def __init__(self, board: Board) -> None:
        self.board = board
        self.steps: list[Step] = []

    def short(self, value: Scalar) -> Expr:
        """A tree for a known quantity: as it is where that is short, else a name, defined in a step."""
        known = self.board.known_as(value)
        if known is not None:
            return known
        negative = starts_negative(self.board.tree(value))
        symbol = self.board.define(self.board.next_name(), -value if negative else value)
        self.steps.append(Step(symbol.name, (symbol, self.board.value_of(symbol)), "name"))
        return negate(symbol) if negative else symbol

    def name(self, value: Expr) -> Symbol:
        """A name for a tree, told aside."""
        symbol = Symbol(self.board.next_name())
        self.board.items.append(Definition(symbol, value))
        self.steps.append(Step(symbol.name, (symbol, value), "aside"))
        return symbol

    def add(self, rule: str, *chain: Expr, **facts: Any) -> str:
        """A step by a rule; its name."""
        self.board.steps += 1
        self.steps.append(Step(f"{rule}_{self.board.steps}", chain, rule, facts))
        return self.steps[-1].name

    def equation(self, left: Expr, right: Expr) -> None:
        """An equation, unless it stands on the board already."""
        if not self.board.shown((left, right)):
            self.add("equation", left, right)

    def holds(self, *chain: Expr) -> bool:
        """Whether this move says so already."""
        return any(step.chain == chain for step in self.steps)

    def named(self, rule: str) -> list[str]:
        """The names of the steps by a rule."""
        return [step.name for step in self.steps if step.rule == rule]

    def move(
        self, of: Form | str, head: Expr, options: Sequence[Option], facts: Mapping[str, Any],
        shown: Sequence[Option] = (), trig: Mapping[int, Mapping[Expr, Expr]] | None = None,
    ) -> Move:  # fmt: skip
        """The finished move; `shown` are its values as the page writes them, where that differs."""
        for option in shown or options:
            self.add("option", head, option.value)
        told = {rule: self.named(step) for rule, step in RULES.items()}
        return Move(
            len(self.board.moves), of, head, tuple(options), tuple(self.steps), {**told, **facts}, trig or {}
        )


RULES = {
    "names": "name", "equations": "equation", "solved": "solved", "aside": "aside", "squares": "squares",
    "options": "option",
}  # fmt: skip
