"""One sub-problem while its solution is written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from derive.algebra.angles import Form
from derive.algebra.infix import text
from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Phrase, Step
from derive.expression import Expr, Relation, Symbol
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._inverse.compared import Poses
from derive.kinds.robot._inverse.facts import Compared, Method, SolvedFacts
from derive.kinds.robot._inverse.progress import Progress
from derive.kinds.robot._inverse.signs import all_negative, begins_negative, opposite
from derive.kinds.robot._inverse.subproblem import Choice, Definition, Solved
from derive.mechanics.inverse.subproblems import Joined, Reach, SubProblem, equations_of
from derive.mechanics.inverse.wrist import Spherical
from derive.mechanics.poses import rotation_part
from derive.mechanics.zeros import never_zero

ORDER = ("name", "equation", "squares", "aside", "form", "solved", "choice")  # of steps on the page
BY_ROOT = (
    "equation",
    "squares",
    "name",
    "split",
    "joined",
    "half",
    "quartic",
    "aside",
    "expanded",
    "squared",
    "choice",
)
BY_HEIGHT = ("equation", "squares", "aside", "name", "solved", "choice")
BY_PRODUCT = ("equation", "squares", "name", "twice", "solved", "choice")
BY_LENGTH = ("equation", "solved", "name", "choice")  # where the names are other elements

TWO = {  # by the rule, and whether other elements give the size of the other function
    ("cosine", False): "two-of-a-cosine", ("sine", False): "two-of-a-sine",
    ("cosine", True): "size-of-the-sine", ("sine", True): "size-of-the-cosine",
}  # fmt: skip
OPEN = {
    "direction": "singular-if", "difference": "arbitrary-only-if", "zero": "arbitrary-if",
    "determinant": "no-determinant", "slide": "no-slope",
    "quadratic": "no-slope", "cosine": "not-by-this-if",
    "sine": "not-by-this-if",
}  # fmt: skip
NEVER_ZERO = ("positive", "nonzero")  # what a sheet may take a symbol to be
BY_A_SLIDE = ("direction", "cosine", "sine")  # a slide at zero may take the angle out of all that is known
ALL_TOGETHER = ("difference", "zero")  # what must not vanish, must not all at once


class Solving:
    """One sub-problem while its solution is written; `poses` are those its equations stand in."""

    def __init__(
        self, progress: Progress, poses: Poses, found: SubProblem, wrist: Spherical | None = None
    ) -> None:
        self.progress, self.problem, self.wrist = progress, progress.problem, wrist
        self.poses, self.found = poses, found
        self.steps: list[Step] = []
        self.equations: list[tuple[Expr, Expr]] = []

    def short(self, value: Scalar) -> Expr:
        """A tree for a known quantity: as it is where that is short, else a name, defined in a step."""
        known = self.progress.known_as(value)
        if known is not None:
            return known
        negative = begins_negative(self.progress.tree(value))
        symbol = self.progress.define(self.progress.next_name(), -value if negative else value)
        self.steps.append(Step(symbol.name, (symbol, self.progress.value_of(symbol)), "name"))
        return -symbol if negative else symbol

    def name(self, value: Expr) -> Symbol:
        """A name for a tree, said aside."""
        symbol = Symbol(self.progress.next_name())
        self.progress.items.append(Definition(value, symbol))
        self.steps.append(Step(symbol.name, (symbol, value), "aside"))
        return symbol

    def add(self, rule: str, *chain: Expr) -> None:
        """A step by a rule."""
        self.progress.steps += 1
        self.steps.append(Step(f"{rule}_{self.progress.steps}", chain, rule))

    def equation(self, *sides: tuple[Expr, Expr]) -> None:
        """Equations that are read together, shown unless all of them were before."""
        self.equations += sides
        told = (step.chain for each in self.progress.solved for step in each.steps)
        before = [(chain[0], chain[-1]) for chain in told]
        if any(each not in before for each in sides):
            for left, right in sides:
                self.add("equation", left, right)

    def solved(
        self, head: Expr, choices: Sequence[Choice], method: Method, shown: Sequence[Choice] = (),
        trig: Mapping[int, Mapping[Expr, Expr]] | None = None,
    ) -> None:  # fmt: skip
        """The unknown has these values; `shown` are they as the page writes them, where that differs. Joints
        and signs that are decided so are known from now on."""
        progress, unknown = self.progress, self.found.unknown
        method = replace(method, unless=self._where_it_breaks(method))
        self._sides_named()
        told = [choice.value for choice in shown or choices]
        if method.by_name and isinstance(unknown, Form) and len(unknown.parts) > 1:
            progress.is_given(head, told[0])
        named = progress.name_of(unknown, told) if isinstance(unknown, Form) else None
        for k, value in enumerate(told):
            self.add("choice", *((named,) if named else ()), *((head,) if not (named and k) else ()), value)
        left: tuple[Step, ...] = ()
        if isinstance(unknown, Form):
            sum_is = named or (told[0] if len(unknown.parts) > 1 else head)
            left = progress.left_of(unknown, sum_is)
        compared = self.poses.compared(equations_of(self.found))
        read = self.by("equation") or (self.by("solved") and not self.by("squares"))
        again = self._again(compared) if read else None
        side = choices[0].signed if method.name in ("zero", "general") else None
        facts = SolvedFacts(
            method=method,
            unknown=head,
            single=not (isinstance(unknown, Form) and len(unknown.parts) > 1),
            called=named or head,
            compared=compared if read and not again else (),
            again=again,
            two=Phrase(TWO[method.name, method.by_length]) if method.name in ("cosine", "sine") else None,
            open=self._open(method, named or head),
            positive=side if side and not all_negative(side) else None,
            negative=opposite(side) if side and all_negative(side) else None,
            orientation=progress.goal.R is not None and None in progress.goal.p,
            whole=progress.goal.R is not None and None not in progress.goal.p,
            resting=self._resting(choices, method),
            sides=self._sides() if method.name in ("direction", "difference") else (),
            names=self.by("name"),
            equations=self.by("equation"),
            squares=self.by("squares"),
            aside=(*self.by("aside"), *self.by("twice")),
            form=next(iter(self.by("form")), None),
            solved=self.by("solved"),
            choices=self.by("choice"),
            left=left,
        )
        number = len(progress.solved)
        order: tuple[str, ...] = BY_ROOT if method.quartic else BY_LENGTH if method.by_length else ORDER
        order = BY_PRODUCT if method.half else BY_HEIGHT if method.name == "quadratic" else order
        steps = (*(step for rule in order for step in self.by(rule)), *left)
        solved = Solved(
            number, unknown, head, tuple(choices), steps, facts, self.poses.stage, trig or {},
            tuple(self.equations), compared, named,
        )  # fmt: skip
        if solved.two_valued and trig:
            progress.signs[f"{'sin' if method.name == 'cosine' else 'cos'}({unknown})"] = number
        elif solved.two_valued and isinstance(self.found, Reach) and not self.found.linear:
            progress.signs[self.found.unknown] = number
        progress.items.append(solved)

    def _sides_named(self) -> None:
        """The known side of an equation that has a name: what it stands for is told in the equation."""
        names = {step.chain[0]: step for step in self.steps if step.rule == "name"}
        sides = names.keys() & {step.chain[0] for step in self.steps if step.rule == "equation"}
        self.steps = [
            replace(step, chain=(*names[step.chain[0]].chain, *step.chain[1:]))
            if step.chain[0] in sides
            else step
            for step in self.steps
            if step.rule != "name" or step.chain[0] not in sides
        ]

    def _sides(self) -> tuple[Expr, ...]:
        """The known sides of the equations, where those stand above."""
        return () if self.by("equation") else tuple(sorted((left for left, _ in self.equations), key=text))

    def _again(self, compared: tuple[Compared, ...]) -> Phrase | None:
        """That the same equations were read before, where something has become known since."""
        before = self.progress.solved
        joined = isinstance(self.found, Joined)
        if not joined and not any(each.compared == compared for each in before):
            return None
        key = "joined-equations" if joined else "same-equations"
        return Phrase(key, {"known": before[-1].facts.called})

    def _where_it_breaks(self, method: Method) -> tuple[Relation, ...]:
        """What must not vanish, if it can."""
        found = tuple(each for each in method.unless if self._may_hold(each))
        return () if method.name in ALL_TOGETHER and len(found) < len(method.unless) else found

    def _may_hold(self, zero: Relation) -> bool:
        """Whether something may vanish; numbers may keep sines and cosines from it, and a sign a length."""
        if isinstance(zero.left, Symbol) and self.problem.assumptions.get(zero.left.name) in NEVER_ZERO:
            return False
        variables = tuple(self.problem.subject.variables)
        value = None if isinstance(zero.left, Relation) else normal(zero.left)
        return value is None or not (value.letters() <= {*variables} and never_zero(value, variables))

    def _open(self, method: Method, unknown: Expr) -> Phrase | None:
        """Where the rule says nothing of the unknown."""
        if not method.unless:
            return None
        key = "singular-and-arbitrary-if" if self._matters_no_more(method, unknown) else OPEN[method.name]
        return Phrase(key, {"zeros": method.unless, "unknown": unknown})

    def _resting(self, choices: Sequence[Choice], method: Method) -> tuple[Symbol, ...]:
        """The joints found before on which it rests whether the value is real."""
        if method.bound is not None:
            sides = (method.bound.left, method.bound.right)
            return self.progress.rests_on(*(side for side in sides if not isinstance(side, Relation)))
        return self.progress.rests_on(*(each.value for each in choices)) if method.exists is not None else ()

    def _matters_no_more(self, method: Method, unknown: Expr) -> bool:
        """Whether a slide at zero, which leaves the unknown open, takes it out of all that is known."""
        slide: Expr | Relation | None = method.factor
        if method.name in ("cosine", "sine") and len(method.unless) == 1:
            slide = method.unless[0].left
        goal = self.progress.goal
        if not (isinstance(slide, Symbol) and isinstance(unknown, Symbol)) or method.name not in BY_A_SLIDE:
            return False
        chain, wrist = chain_of(self.problem), self.wrist
        if wrist and self.poses.shoulder:
            return False
        known: list[Scalar]
        if wrist and self.poses.stage == "arm":  # which the hand then turns as it should
            known = [*(chain.T[wrist.frame] @ ScalarMatrix.column((*wrist.inside.entries, 1))).entries[:3]]
        else:
            T = chain.T_tool
            known = [T.rows[i][3] for i, each in enumerate(goal.p) if each is not None]
            known += rotation_part(T).entries if goal.R is not None or goal.angle else ()
        return not any(each.diff(unknown.name).substitute({slide.name: Scalar.of(0)}) for each in known)

    def by(self, rule: str) -> tuple[Step, ...]:
        """Its steps by a rule."""
        return tuple(step for step in self.steps if step.rule == rule)
