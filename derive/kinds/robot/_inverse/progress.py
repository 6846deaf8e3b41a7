"""How far an inverse is solved: the names given so far, the signs chosen, the sub-problems solved."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from derive.algebra.angles import Form
from derive.algebra.infix import text
from derive.algebra.normal import normal, trig_of
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import Call, Expr, Symbol, add, free_symbols, is_negative
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.signs import leaves, opposite, ordered, signed, unsigned
from derive.kinds.robot._inverse.subproblem import Definition, Item, Solved, shares
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.known import determined

LONG = 3  # names and numbers in an expression; a longer one gets a name of its own


class Progress:
    """What is solved, in the order of the page. `turning` are the revolute joints in order."""

    def __init__(
        self, problem: Problem, goal: Goal, turning: Sequence[str], free_name: Callable[[str], str]
    ) -> None:
        self.problem, self.goal, self.turning = problem, goal, tuple(turning)
        self.free_name = free_name
        self.items: list[Item] = []
        self.named: list[tuple[Symbol, Scalar]] = []
        self.signs: dict[str, int] = {}  # generator -> the sub-problem whose sign it has
        self.sums: list[tuple[Scalar, int]] = []  # likewise of sums
        self.forms: list[Form] = []
        self.steps = 0

    # -- names ------------------------------------------------------------------------------------

    def define(self, name: str, value: Scalar) -> Symbol:
        """A name for a known quantity."""
        symbol = Symbol(name)
        self.named.append((symbol, value))
        self.items.append(Definition(self.tree(value), symbol))
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
                return -symbol
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
        return opposite(angle) if normal(angle) == -total else angle  # a cosine is the same of both

    # -- sub-problems -----------------------------------------------------------------------------

    @property
    def solved(self) -> list[Solved]:
        """The sub-problems so far."""
        return [item for item in self.items if isinstance(item, Solved)]

    def determined(self) -> list[str]:
        """The joints that the sums found so far determine."""
        return [joint for joint in self.turning if determined(joint, self.forms)]

    def sign_of(self, value: Scalar) -> tuple[int, tuple[int, ...]]:
        """The sign of a term or of a sum, and the sub-problems whose signs it has as factors; 0 where it is
        not known."""
        for known, number in self.sums:
            if value and (ratio := (value / known).constant) is not None:
                return (1 if ratio > 0 else -1), (number,)
        terms = list(value.numerator.terms())
        if len(terms) != 1 or value.denominator is not None:
            return 0, ()
        exponents, coefficient = terms[0]
        odd = [name for name, power in zip(value.ring.names, exponents, strict=True) if power % 2]
        positive = [name for name, sign in self.problem.assumptions.items() if sign == "positive"]
        open_ones = [name for name in odd if not name.startswith("sqrt(") and name not in positive]
        if any(name not in self.signs for name in open_ones):
            return 0, ()
        return (1 if coefficient > 0 else -1), tuple(self.signs[name] for name in open_ones)

    def left_of(self, form: Form) -> tuple[Step, ...]:
        """The joints that a sum determines together with those known before it, once it is known."""
        before = self.determined()
        self.forms.append(form)
        fresh = [joint for joint in self.determined() if joint not in before]
        return tuple(self._left(joint) for joint in fresh if Form.of({joint: 1}) not in self.forms)

    def _left(self, joint: str) -> Step:
        """A joint angle as what is left of a sum."""
        weights = shares(joint, tuple(self.forms), self.turning) or ()
        parts = [(form, n) for form, n in zip(self.forms, weights, strict=True) if n]
        parts.sort(key=lambda part: (-len(part[0].parts), self.turning.index(part[0].parts[0][0])))
        terms = [signed(n, self.angle(form)) for form, n in parts]
        return Step(f"{joint}_left", (Symbol(joint), add(*sorted(terms, key=is_negative))), "difference")
