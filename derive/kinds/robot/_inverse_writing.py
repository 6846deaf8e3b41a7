"""What is found by a plan of sub-problems, written as a person would on the board."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from derive.algebra.angles import Form, combination
from derive.algebra.normal import trig_of
from derive.algebra.scalar import Scalar, as_fraction
from derive.algebra.text import text
from derive.derivation import Step
from derive.expression import (
    ONE,
    ZERO,
    Call,
    Degrees,
    Expr,
    Number,
    Quotient,
    Symbol,
    add,
    atan2,
    children,
    cos,
    is_negative,
    multiply,
    negate,
    number,
    sin,
    sqrt,
    squared,
    subtract,
)
from derive.kinds.problem import Problem
from derive.kinds.robot._inverse_moves import Definition, Item, Move, Option, minus, ordered, shares, size_of
from derive.mechanics.inverse.equation import Equation
from derive.mechanics.inverse.goal import Goal
from derive.mechanics.inverse.search import Found, Stage, equations_of
from derive.mechanics.inverse.slide import Slide
from derive.mechanics.inverse.squares import Elbow, Part, Reach
from derive.mechanics.inverse.trigonometric import OneEquation, Row, TwoEquations

SIGNS = (1, -1)
LONG = 3  # names and numbers in an expression from which on it gets a name of its own
LONG_CONDITION = 60  # letters


class Writer:
    """Writes the moves of one plan in order; remembers the names it gave and the signs it may use."""

    def __init__(
        self, problem: Problem, goal: Goal, turning: Sequence[str], free_name: Callable[[str], str]
    ) -> None:
        self.problem, self.goal, self.turning, self.free_name = problem, goal, tuple(turning), free_name
        self.items: list[Item] = []
        self.named: list[tuple[Symbol, Scalar]] = []
        self.signs: dict[str, int] = {}  # generator -> the move whose sign it has
        self.forms: list[Form] = []

    # -- names ------------------------------------------------------------------------------------

    def define(self, name: str, value: Scalar) -> Symbol:
        """A name for a known quantity."""
        symbol = Symbol(name)
        self.named.append((symbol, value))
        self.items.append(Definition(symbol, self.tree(value)))
        return symbol

    def short(self, value: Scalar) -> tuple[Expr, list[Step]]:
        """A tree for a known quantity: as it is where that is short, else a name, defined in a step."""
        tree = self.tree(value)
        if leaves(tree) <= LONG:
            return tree, []
        for symbol, known in self.named:
            if known == value:
                return symbol, []
            if known == -value:
                return negate(symbol), []
        leading = isinstance(tree, Call) or not text(tree).startswith("-")
        symbol = self.define(self._next_name(), value if leading else -value)
        step = Step(symbol.name, (symbol, self.value_of(symbol)), "name")
        return (symbol if leading else negate(symbol)), [step]

    def value_of(self, symbol: Symbol) -> Expr:
        """What a name stands for."""
        return next(i.value for i in self.items if isinstance(i, Definition) and i.name == symbol)

    def _next_name(self) -> str:
        count = sum(1 for item in self.items if isinstance(item, Definition) and item.name.name[:2] == "k_")
        return str(self.free_name(f"k_{count + 1}"))

    @property
    def next_move(self) -> int:
        return sum(isinstance(item, Move) for item in self.items)

    # -- moves ------------------------------------------------------------------------------------

    def write(self, stage: Stage, found: Found, facts: Mapping[str, Any]) -> None:
        """The next move, its names before it."""
        match found:
            case TwoEquations():
                move = self.two(found)
            case OneEquation(angle, row):
                move = self.one(angle, row, stage)
            case Elbow():
                move = self.elbow(found)
            case Reach():
                move = self.reach(found)
            case Slide():
                move = self.slide(found)
        self.learn(move, {**facts, **move.facts, "unknown": move.head})

    def learn(self, move: Move, facts: Mapping[str, Any]) -> None:
        place = move.number
        differences: list[Step] = []
        if isinstance(move.of, Form):
            before = self._determined()
            self.forms.append(move.of)
            fresh = [joint for joint in self._determined() if joint not in before]
            differences = self.differences(fresh)
        facts = {
            "squares": "",
            "solved": [],
            "target": "orientation" if self.goal.R is not None and None in self.goal.p else "position",
            **facts,
            "options": [step.name for step in move.steps if step.rule == "option"],
            "differences": [step.name for step in differences],
        }
        steps = (*move.steps, *differences)
        self.items.append(Move(place, move.of, move.head, move.options, steps, facts, move.trig))
        chosen = any(option.sign for option in move.options)
        if isinstance(move.of, Form):
            if chosen and move.trig:
                function = "sin" if facts["method"].startswith("cosine") else "cos"
                self.signs[f"{function}({move.of})"] = place
        elif chosen and facts.get("symmetric"):
            self.signs[move.of] = place

    def angle(self, form: Form) -> Expr:
        """theta2 + theta3 as it is printed in its cosine."""
        c, _ = trig_of(_linear(form))
        tree = self.problem.readable(c)
        return tree.arguments[0] if isinstance(tree, Call) else tree

    def two(self, found: TwoEquations) -> Move:
        """Two equations in one angle: no choice is left, unless signs were chosen before."""
        angle = self.angle(found.angle)
        steps: list[Step] = []
        found = self._positive(found)
        sides = [self._collected(row, angle, steps) for row in (found.first, found.second)]
        method = {"direction": self._direction, "difference": self._difference, "determinant": self._cramer}
        options, more = method[found.kind](found, sides, steps)
        facts = {
            "method": found.kind,
            "by_name": False,
            "names": [step.name for step in steps if step.rule == "name"],
            "equations": [step.name for step in steps if step.rule == "equation"],
            **more,
        }
        steps += self._option_steps(angle, options)
        return Move(self.next_move, found.angle, angle, options, tuple(steps), facts)

    def _positive(self, found: TwoEquations) -> TwoEquations:
        """With as few minus signs in the known sides and coefficients as can be."""
        first, second = found.first, found.second
        if found.kind == "difference":
            pairs = [(first, second), (first.negated(), second.negated())]
            pairs += [(second, first.negated()), (second.negated(), first)]
        else:
            pairs = [(one, two) for one in (first, first.negated()) for two in (second, second.negated())]
        best = min(pairs, key=lambda pair: self._minuses(pair[0].c, pair[1].c, pair[0].a, pair[1].b))
        return replace(found, first=best[0], second=best[1])

    def _minuses(self, *values: Scalar) -> int:
        """How many minus signs these are written with; the first ones weigh more, and those in front."""
        written = [text(self.tree(value)) for value in values]
        signs = [each.count("-") + each.startswith("-") for each in written]
        return sum(2 ** (len(signs) - place) * count for place, count in enumerate(signs))

    def tree(self, value: Scalar) -> Expr:
        """As a person writes it, what is subtracted last."""
        return ordered(self.problem.readable(value))

    def _collected(self, row: Row, angle: Expr, steps: list[Step]) -> tuple[Expr, Expr, Expr]:
        """(a, b, c) as trees, with a step c = a cos q + b sin q."""
        trees = []
        for value in (row.c, row.a, row.b):
            tree, made = self.short(value)
            trees.append(tree)
            steps += made
        c, a, b = trees
        chain = (c, add(_times(a, cos(angle)), _times(b, sin(angle))))
        if not self._shown(chain):
            steps.append(self._step("equation", chain))
        return a, b, c

    def _direction(
        self, found: TwoEquations, sides: Sequence[tuple[Expr, Expr, Expr]], steps: list[Step]
    ) -> tuple[tuple[Option, ...], dict[str, Any]]:
        """cos = c1 / a, sin = c2 / b."""
        (a, _, c1), (_, b, c2) = sides
        first, second = found.first, found.second
        ratio = (second.b / first.a).constant
        if ratio is not None:
            sign, earlier = self.sign_of(first.a)
            plain = self._given_angle(found) if not earlier else None
            if plain is not None:
                return (Option(plain),), {"unless": [], "by_name": True}
            if sign:
                sine = c2 if abs(ratio) == 1 else Quotient(c2, number(abs(ratio)))
                sine = sine if ratio > 0 else minus(sine)
                if first.a.constant is not None:
                    earlier = ()
                return self._turned(sine, c1, sign, earlier), {
                    "unless": [] if first.a.constant is not None else [size_of(a)],
                    "factor": None if first.a.constant is not None else size_of(a),
                }
        value = atan2(_over(c2, b), _over(c1, a))
        return (Option(value),), {"unless": [t for t in (a, b) if not isinstance(t, Number)]}

    def _turned(self, y: Expr, x: Expr, sign: int, earlier: tuple[int, ...]) -> tuple[Option, ...]:
        plus = y, x
        turned = minus(y), minus(x)
        if not earlier:
            return (Option(atan2(*(plus if sign > 0 else turned))),)
        return tuple(
            Option(atan2(*(plus if sign * product > 0 else turned)), earlier=earlier, product=product)
            for product in SIGNS
        )

    def _given_angle(self, found: TwoEquations) -> Expr | None:
        """The given angle itself, where its cosine and sine stand alone."""
        if self.goal.angle is None:
            return None
        c, s = found.first.c / found.first.a, found.second.c / found.second.b
        for sign in SIGNS:
            for quarters in (0, 1, 2, -1):
                turned = Scalar.symbol(self.goal.angle) * sign + Scalar.symbol("pi") * number(quarters).value / 2
                if trig_of(turned) == (c, s):
                    name = Symbol(self.goal.angle)
                    fixed = _quarters(quarters, self.problem)
                    return add(name if sign > 0 else negate(name), fixed)
        return None

    def _difference(
        self, found: TwoEquations, sides: Sequence[tuple[Expr, Expr, Expr]], steps: list[Step]
    ) -> tuple[tuple[Option, ...], dict[str, Any]]:
        """c1 = k1 cos - k2 sin, c2 = k2 cos + k1 sin."""
        (k1, _, c1), (k2, _, c2) = sides
        value = subtract(atan2(c2, c1), atan2(k2, k1))
        return (Option(value),), {"unless": [k1, k2]}

    def _cramer(
        self, found: TwoEquations, sides: Sequence[tuple[Expr, Expr, Expr]], steps: list[Step]
    ) -> tuple[tuple[Option, ...], dict[str, Any]]:
        (a1, b1, c1), (a2, b2, c2) = sides
        D, made = self.short(found.determinant)
        steps += made
        cosine = subtract(multiply(c1, b2), _times(c2, b1))
        sine = subtract(multiply(a1, c2), _times(a2, c1))
        sign, earlier = self.sign_of(found.determinant)
        if sign:
            return self._turned(sine, cosine, sign, earlier), {"unless": [D]}
        return (Option(atan2(_over(sine, D), _over(cosine, D))),), {"unless": [D]}

    def one(self, angle: Form, row: Row, stage: Stage) -> Move:
        """One equation in one angle: two values."""
        q = self.angle(angle)
        steps: list[Step] = []
        equation = row.equation
        row = self._plainest(row)
        a, b, c = self._row_trees(row, steps)
        chain = self._as_seen(equation, angle, (a, b, c))
        if not self._shown(chain):
            steps.append(self._step("equation", chain))
        sizes = self._sizes(equation, row, stage)
        return self._solved(angle, q, (a, b, c), row, steps, sizes)

    def _as_seen(self, equation: Equation, angle: Form, trees: tuple[Expr, Expr, Expr]) -> tuple[Expr, Expr]:
        """The known side, by its name where it has one, and the other; as they stand in the view where the
        angle is on the side of the known pose."""
        a, b, c = trees
        left, right = (self.tree(side) for side in (equation.left, equation.right))
        if any(equation.left.diff(atom) for atom, _ in angle.parts):
            return left, right
        q = self.angle(angle)
        return c, add(_times(a, cos(q)), _times(b, sin(q)))

    def _plainest(self, row: Row) -> Row:
        """Of both signs the one with fewer minus signs in its solution."""
        return min((row, row.negated()), key=lambda r: min(self._by_sines(r), self._by_cosines(r)))

    def _by_sines(self, row: Row) -> int:
        return self._minuses(row.a, -row.b) if row.a and row.b else self._minuses(row.a, row.b, row.c)

    def _by_cosines(self, row: Row) -> int:
        return self._minuses(row.b, row.a, row.c)

    def _row_trees(self, row: Row, steps: list[Step]) -> tuple[Expr, Expr, Expr]:
        trees = []
        for value in (row.a, row.b, row.c):
            tree, made = self.short(value) if value else (ZERO, [])
            trees.append(tree)
            steps += made
        return trees[0], trees[1], trees[2]

    def _sizes(self, equation: Equation, row: Row, stage: Stage) -> tuple[Expr, list[Step]] | None:
        """sqrt(k1^2 + k2^2) of the other two entries in the row or column of a rotation matrix whose third
        entry is plus or minus the cosine or sine: the size of the other function."""
        alone = row.a if row.b == 0 else row.b
        if equation.is_position or alone.constant not in (1, -1) or (row.a and row.b):
            return None
        entries = {one.equation.place: one.equation for one in stage.equations}
        view, i, j = equation.place
        lines = ([(view, i, k) for k in range(3) if k != j], [(view, k, j) for k in range(3) if k != i])
        known = [[entries[place].left for place in line] for line in lines if all(p in entries for p in line)]
        if not known:
            return None
        line = min(known, key=lambda values: sum(len(v.numerator) for v in values))
        trees, steps = [], []
        for value in line:
            tree, made = self.short(value)
            trees.append(tree if not text(tree).startswith("-") else minus(tree))
            steps += made
        return sqrt(add(*map(squared, trees))), steps

    def _solved(
        self, angle: Form, q: Expr, trees: tuple[Expr, Expr, Expr], row: Row, steps: list[Step],
        sizes: tuple[Expr, list[Step]] | None = None, extra: Mapping[str, Any] | None = None,
    ) -> Move:  # fmt: skip
        """a cos q + b sin q = c."""
        a, b, c = trees
        if sizes:
            steps += sizes[1]
        if row.b == 0 or row.a == 0:
            even = row.b == 0
            u = _over(c, a if even else b)
            function = cos(q) if even else sin(q)
            plain = any(step.chain == (u, function) for step in steps)
            if not plain:
                steps.append(self._step("solved", (function, u)))
            page = sizes[0] if sizes else sqrt(subtract(ONE, squared(function)))
            value = sizes[0] if sizes else sqrt(subtract(ONE, squared(u)))
            options, shown, trig = self._alone(q, even, u, function, page, value)
            facts = {
                "method": "cosine" if even else "sine",
                "exists": None if sizes else u if plain else function,
                "sizes": bool(sizes),
            }
        elif row.c == 0 and not extra:
            options = self._zero(q, a, b, row)
            shown, trig, facts = options, {}, {"method": "zero", "both": [size_of(b), size_of(a)]}
        else:
            options = self._general(q, a, b, c, row)
            shown, trig = options, {}
            x, y = self._direction_of(row, a, b)
            facts = {"method": "general", "least": add(squared(size_of(x)), squared(size_of(y)))}
            facts["c"] = squared(size_of(c))
            facts["form"] = (add(_times(a, cos(q)), _times(b, sin(q))), c) if extra else None
        facts |= {
            "names": [step.name for step in steps if step.rule == "name"],
            "equations": [step.name for step in steps if step.rule == "equation"],
            "solved": [step.name for step in steps if step.rule == "solved"],
            "aside": [step.name for step in steps if step.rule == "aside"],
            **(extra or {}),
        }
        steps += self._option_steps(q, shown)
        return Move(self.next_move, angle, q, options, tuple(steps), facts, trig)

    def _alone(
        self, q: Expr, even: bool, u: Expr, function: Expr, page: Expr, value: Expr
    ) -> tuple[tuple[Option, ...], tuple[Option, ...], dict[int, dict[Expr, Expr]]]:
        """cos q = u or sin q = u: q by the sign of the other function."""
        options, shown, trig = [], [], {}
        for sign in SIGNS:
            relation = f"{text(q if even else cos(q))} {'>' if sign > 0 else '<'} 0"
            other, seen = (size if sign > 0 else negate(size) for size in (value, page))
            pair, written = ((other, u), (seen, function)) if even else ((u, other), (function, seen))
            options.append(Option(atan2(*pair), sign, relation))
            shown.append(Option(atan2(*written), sign, relation))
            trig[sign] = {function: u, (sin(q) if even else cos(q)): other}
        return tuple(options), tuple(shown), trig

    def _zero(self, q: Expr, a: Expr, b: Expr, row: Row) -> tuple[Option, ...]:
        """a cos q + b sin q = 0: opposite directions."""
        return tuple(
            Option(atan2(*((a, minus(b)) if sign > 0 else (minus(a), b))), sign, self._side(q, row, sign))
            for sign in SIGNS
        )

    def _general(self, q: Expr, a: Expr, b: Expr, c: Expr, row: Row) -> tuple[Option, ...]:
        """With b negative by sines of differences, as Craig does; by cosines otherwise."""
        by_sines = self._by_sines(row) <= self._by_cosines(row)
        x, y = self._direction_of(row, a, b)
        size = sqrt(add(squared(size_of(x)), squared(size_of(y)), negate(squared(size_of(c)))))
        options = []
        for sign in SIGNS:
            if by_sines:
                inner = atan2(size_of(c), size if sign > 0 else negate(size))
                value = (add if is_negative(c) else subtract)(atan2(y, x), inner)
            else:
                value = add(atan2(y, x), atan2(size, c) if sign > 0 else negate(atan2(size, c)))
            options.append(Option(value, sign, self._side(q, row, sign)))
        return tuple(options)

    def _direction_of(self, row: Row, a: Expr, b: Expr) -> tuple[Expr, Expr]:
        """The direction the angle is counted from, by sines or by cosines."""
        return (minus(b), a) if self._by_sines(row) <= self._by_cosines(row) else (a, b)

    def _side(self, q: Expr, row: Row, sign: int) -> str:
        """Which of two angles: the sign of a sin q - b cos q."""
        angle = next(iter(_forms(row, q)), None)
        relation = ">" if sign > 0 else "<"
        if angle is not None:
            c, s = angle
            condition = text(self.problem.readable(row.a * s - row.b * c))
            if len(condition) <= LONG_CONDITION:
                return f"{condition} {relation} 0"
        return f"{'plus' if sign > 0 else 'minus'} sign in {text(q)}"

    def elbow(self, found: Elbow) -> Move:
        """The sum of squares in one angle."""
        q, steps = self.angle(found.angle), []
        known = self._known_sides(found.parts, steps)
        row, common = _reduced(found.row)
        a, made_a = self.short(row.a)
        b, made_b = self.short(row.b) if row.b else (ZERO, [])
        steps += [*made_a, *made_b]
        total = add(*map(squared, known))
        terms = [term for term in _terms(self.problem.readable(-row.c)) if term != ZERO]
        whole = self.problem.readable(row.a * common), self.problem.readable(row.b * common)
        inside = add(_times(whole[0], cos(q)), _times(whole[1], sin(q)))
        squares = self._step("squares", (total, add(*terms, *_terms(inside))))
        steps.append(squares)
        c = _over(add(*_terms(total), *map(minus, terms)), self.problem.readable(common))
        if row.b and row.a:
            symbol = Symbol(self._next_name())
            self.items.append(Definition(symbol, c))
            steps.append(Step(symbol.name, (symbol, c), "aside"))
            c = symbol
        extra = {"squares": squares.name, "law": len(known)}
        return self._solved(found.angle, q, (a, b, c), row, steps, None, extra)

    def reach(self, found: Reach) -> Move:
        """The sum of squares in one displacement."""
        d, steps = Symbol(found.slide), []
        known = self._known_sides(found.parts, steps)
        total = add(*map(squared, known))
        P, Q, D = (self.problem.readable(v) for v in (found.square, found.linear, found.constant))
        inside = add(_times(P, squared(d)), _times(Q, d), D)
        squares = self._step("squares", (total, inside))
        steps.append(squares)
        symmetric = not found.linear
        rest = add(*_terms(total), *(minus(t) for t in _terms(D) if t != ZERO))
        if symmetric:
            size = sqrt(_over(rest, P))
            values = [size, negate(size)]
        else:
            root = sqrt(subtract(squared(Q), multiply(number(4), P, subtract(D, total))))
            values = [_over(add(minus(Q), s), multiply(number(2), P)) for s in (root, negate(root))]
        relation = (">", "<")
        options = tuple(
            Option(v, s, f"{d.name} {r} 0" if symmetric else f"{'plus' if s > 0 else 'minus'} sign in {d.name}")
            for v, s, r in zip(values, SIGNS, relation, strict=True)
        )
        positive = symmetric and self.problem.assumptions.get(d.name) in ("positive", "nonnegative")
        options = options[:1] if positive else options
        facts = {
            "method": "reach",
            "names": [step.name for step in steps if step.rule == "name"],
            "equations": [step.name for step in steps if step.rule == "equation"],
            "squares": squares.name,
            "symmetric": symmetric,
            "positive": positive,
            "exists": rest,
            "law": len(known),
        }
        steps += self._option_steps(d, options)
        return Move(self.next_move, found.slide, d, options, tuple(steps), facts)

    def _known_sides(self, parts: Sequence[Part], steps: list[Step]) -> list[Expr]:
        """The known side of each equation, with a step that says what it equals."""
        known = []
        for part in parts:
            value, unknown = part.known, part.unknown
            if text(self.tree(value)).startswith("-"):
                value, unknown = -value, -unknown
            tree, made = self.short(value)
            steps += made
            steps.append(self._step("equation", (tree, self.problem.readable(unknown))))
            known.append(tree)
        return known

    def slide(self, found: Slide) -> Move:
        """slope d = value."""
        d, steps = Symbol(found.slide), []
        value, made = self.short(found.value)
        steps += made
        slope, made = self.short(found.slope)
        steps += made
        equation = found.equation
        shown = (self.tree(equation.left), self.tree(equation.right))
        result = _over(value, slope)
        names = [step.name for step in steps if step.rule == "name"]
        if d in shown and result in shown:
            steps = [step for step in steps if step.rule == "name"]
        else:
            steps.append(self._step("equation", shown))
        options = (Option(result),)
        facts = {
            "method": "slide",
            "names": names,
            "equations": [step.name for step in steps if step.rule == "equation"],
            "unless": [] if isinstance(slope, Number) else [slope],
        }
        steps += self._option_steps(d, options)
        return Move(self.next_move, found.slide, d, options, tuple(steps), facts)

    # -- signs and steps --------------------------------------------------------------------------

    def sign_of(self, value: Scalar) -> tuple[int, tuple[int, ...]]:
        """The sign of a single term, and the moves whose signs it has as factors; 0 where it is not known."""
        terms = list(value.numerator.terms())
        if len(terms) != 1 or value.denominator is not None:
            return 0, ()
        exponents, coefficient = terms[0]
        earlier = []
        for name, power in zip(value.ring.names, exponents, strict=True):
            if power % 2 == 0 or name.startswith("sqrt("):
                continue
            if name in self.signs:
                earlier.append(self.signs[name])
            elif self.problem.assumptions.get(name) != "positive":
                return 0, ()
        return (1 if coefficient > 0 else -1), tuple(earlier)

    def _shown(self, chain: tuple[Expr, ...]) -> bool:
        """Whether an earlier move has this very equation."""
        return any(step.chain == chain for item in self.items if isinstance(item, Move) for step in item.steps)

    def _step(self, rule: str, chain: tuple[Expr, ...]) -> Step:
        return Step(f"{rule}_{self._count()}", chain, rule)

    def _count(self) -> int:
        self.made = getattr(self, "made", 0) + 1
        return self.made

    def _option_steps(self, head: Expr, options: Iterable[Option]) -> list[Step]:
        return [
            Step(
                f"{text(head).replace(' ', '')}_{self._count()}",
                (head, option.value),
                "option",
                {"sign": option.sign, "earlier": bool(option.earlier), "product": option.product},
            )
            for option in options
        ]

    def _determined(self) -> list[str]:
        """The joints that the sums found so far determine."""
        return [j for j in self.turning if combination(Form.of({j: 1}), self.forms) is not None]

    def differences(self, joints: Sequence[str]) -> list[Step]:
        """The joints known by sums alone."""
        found = []
        for joint in joints:
            weights = shares(joint, tuple(self.forms), self.turning)
            if weights and Form.of({joint: 1}) not in self.forms:
                parts = sorted(zip(self.forms, weights, strict=True), key=lambda part: -len(part[0].parts))
                terms = [self.angle(f) if n > 0 else negate(self.angle(f)) for f, n in parts if n]
                terms.sort(key=is_negative)
                found.append(Step(f"{joint}_left", (Symbol(joint), add(*terms)), "difference"))
        return found


def leaves(tree: Expr) -> int:
    """How many names and numbers stand in a tree."""
    parts = children(tree)
    return sum(map(leaves, parts)) if parts else int(tree != number(-1))


def _times(factor: Expr, other: Expr) -> Expr:
    """A product with the sign of its first factor in front."""
    if factor == ZERO:
        return ZERO
    if factor == number(-1):
        return negate(other)
    if type(factor).__name__ == "Product" and factor.factors[0] == number(-1):  # type: ignore[union-attr]
        return negate(multiply(*factor.factors[1:], other))  # type: ignore[union-attr]
    return multiply(factor, other)


def _over(top: Expr, bottom: Expr) -> Expr:
    """A quotient; by one it is the top, and signs move above."""
    if bottom == ONE:
        return top
    if text(bottom).startswith("-") and type(bottom).__name__ != "Sum":
        return _over(minus(top), minus(bottom))
    return Quotient(top, bottom)


def _terms(tree: Expr) -> tuple[Expr, ...]:
    return tree.terms if type(tree).__name__ == "Sum" else (tree,)  # type: ignore[union-attr]


def _linear(form: Form) -> Scalar:
    total = Scalar.of(0)
    for atom, n in form.parts:
        total = total + Scalar.symbol(atom) * n
    return total


def _reduced(row: Row) -> tuple[Row, Scalar]:
    """The coefficients without their common factor, and that factor."""
    if not (row.a and row.b):
        alone = row.a or row.b
        one = Scalar(alone.ring, alone.ring.one)
        return replace(row, a=one if row.a else row.a, b=one if row.b else row.b), alone
    home = row.a.ring
    common = Scalar(home, row.a.numerator.gcd(row.b.numerator))
    numbers = [part.constant for part in (row.a / common, row.b / common)]
    content = as_fraction((row.a / common).numerator.leading_coefficient())
    if abs(content) == 1 or numbers[0] is not None:
        content = Fraction(1)
    common = common * abs(content)
    return replace(row, a=row.a / common, b=row.b / common), common


def _forms(row: Row, q: Expr) -> list[tuple[Scalar, Scalar]]:
    from derive.algebra.normal import normal

    return [trig_of(normal(q))]


def _quarters(n: int, problem: Problem) -> Expr:
    if n == 0:
        return ZERO
    if problem.style.degrees:
        return Degrees(number(90 * n).value)
    return multiply(number(f"{n}/2"), Symbol("pi"))


