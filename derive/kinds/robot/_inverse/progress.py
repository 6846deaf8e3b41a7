"""How far an inverse is solved: the names given so far, the signs chosen, the sub-problems solved."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from derive.algebra.angles import Form
from derive.algebra.infix import text
from derive.algebra.normal import normal, trig_of
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import (
    Call,
    Expr,
    Relation,
    Symbol,
    add,
    cos,
    free_symbols,
    is_negative,
    sin,
    terms_of,
    walk,
)
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse.facts import zero
from derive.kinds.robot._inverse.signs import facing, leaves, opposite, ordered, signed, unsigned
from derive.kinds.robot._inverse.subproblem import Definition, Item, Solved, shares, sum_name
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
        self.values: list[Expr] = []  # of the forms: what a sum is called, or is
        self.called: set[str] = set()  # names of sums
        self.by_name: dict[Expr, Expr] = {}  # cosines and sines of sums that are a given angle
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
        return ordered(facing(self.problem.readable(value), self.goal.places))

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

    def may_vanish(self, *trees: Expr) -> tuple[Relation, ...]:
        """That those of these are zero that rest on the pose, each once and without its sign: a length does
        not vanish."""
        given = self.problem.symbols | self.problem.where.keys()
        lengths = given - set(self.problem.subject.variables)
        found = dict.fromkeys(unsigned(tree) for tree in trees if not self._rests_on(tree) <= lengths)
        return zero(*found)

    def _rests_on(self, tree: Expr) -> frozenset[str]:
        """The names in it, and in what they stand for where that is a quantity with a name."""
        found, named = free_symbols(tree), {symbol.name: value for symbol, value in self.named}
        while known := found & named.keys():
            found = (found - known).union(*(named[name].letters() for name in known))
        return found

    def rests_on(self, *trees: Expr) -> tuple[Symbol, ...]:
        """The joint variables in these, and in what their names stand for, in the order of the arm."""
        meant = {item.name.name: item.value for item in self.items if isinstance(item, Definition)}
        meant |= {each.named.name: each.head for each in self.solved if each.named is not None}
        found = frozenset[str]().union(*map(free_symbols, trees))
        while known := found & meant.keys():
            found = (found - known).union(*(free_symbols(meant[name]) for name in known))
        return tuple(Symbol(name) for name in self.problem.subject.variables if name in found)

    def angle(self, form: Form) -> Expr:
        """theta2 + theta3 as it is printed in its cosine."""
        total = Scalar.of(0)
        for atom, n in form.parts:
            total = total + Scalar.symbol(atom) * n
        tree = self.problem.readable(trig_of(total)[0])
        angle = tree.arguments[0] if isinstance(tree, Call) else tree
        return opposite(angle) if normal(angle) == -total else angle  # a cosine is the same of both

    def is_given(self, angle: Expr, value: Expr) -> None:
        """A sum of angles is a given one: its cosine and sine are known by that."""
        c, s = map(self.problem.readable, trig_of(normal(value)))
        self.by_name |= {cos(angle): c, sin(angle): s}

    # -- sub-problems -----------------------------------------------------------------------------

    @property
    def solved(self) -> list[Solved]:
        """The sub-problems so far."""
        return [item for item in self.items if isinstance(item, Solved)]

    def determined(self) -> list[str]:
        """The joints that the sums found so far determine."""
        return [joint for joint in self.turning if determined(joint, self.forms)]

    def reached(self, length: Expr) -> tuple[Solved, Expr] | None:
        """Where the length of a joint was found as a root, and what stands under that."""
        for each in self.solved:
            if each.head == length and each.facts.method.name == "reach":
                match each.choices[0].value:
                    case Call("sqrt", (inside,)):
                        return each, inside
        return None

    def implied(self, solved: Solved) -> None:
        """What a later condition says of it too is left out."""
        method = replace(solved.facts.method, bound=None)
        found = replace(solved, facts=replace(solved.facts, method=method))
        self.items = [found if item is solved else item for item in self.items]

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

    def name_of(self, form: Form, values: Sequence[Expr]) -> Symbol | None:
        """What the page calls a sum of joint angles; None of one angle, and of a sum that is short itself."""
        if len(form.parts) == 1 or (len(values) == 1 and _is_short(values[0])):
            return None
        name, plain = sum_name(form, self.turning, self.free_name), self.free_name("phi")
        if name.startswith("phi_") and plain not in self.called:  # phi_124 would look like a sum of three
            name = plain
        self.called.add(name)
        return Symbol(name)

    def left_of(self, form: Form, value: Expr) -> tuple[Step, ...]:
        """The joints that a sum determines together with those known before it, once it is known by a name or
        by its value."""
        before = self.determined()
        self.forms.append(form)
        self.values.append(value)
        fresh = [joint for joint in self.determined() if joint not in before]
        return tuple(self._left(joint) for joint in fresh if Form.of({joint: 1}) not in self.forms)

    def _left(self, joint: str) -> Step:
        """A joint angle as what is left of a sum."""
        weights = shares(joint, tuple(self.forms), self.turning) or ()
        parts = [each for each in zip(self.forms, self.values, weights, strict=True) if each[-1]]
        parts.sort(key=lambda part: (-len(part[0].parts), self.turning.index(part[0].parts[0][0])))
        terms = [term for _, value, n in parts for term in terms_of(signed(n, value))]
        return Step(f"{joint}_left", (Symbol(joint), add(*sorted(terms, key=is_negative))), "difference")


def _is_short(value: Expr) -> bool:
    """Whether it can stand in a sum for itself."""
    return leaves(value) <= LONG and not any(isinstance(node, Call) for node in walk(value))
