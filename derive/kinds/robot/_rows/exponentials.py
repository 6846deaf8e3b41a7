"""The pose of a chain of screws as a product of exponentials, line by line."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property, partial, reduce
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import Point, matrix_numbers, number
from derive.derivation import Claim, Phrase, Record, Said
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Indexed,
    Matrix,
    Relation,
    Symbol,
    column,
    cross,
    free_symbols,
    multiply,
)
from derive.expression import add as total
from derive.kinds.checks import close, route
from derive.kinds.fields import TREES
from derive.kinds.meanings import valued
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import end_frame
from derive.kinds.robot._columns import product_lines
from derive.kinds.robot._rows.exponential_law import exponential_law
from derive.kinds.work import Work
from derive.mechanics.oracle import STEP, exponential, vee
from derive.mechanics.oracle.rows import helix
from derive.mechanics.poses import composed
from derive.mechanics.robot import Robot
from derive.mechanics.screws import Screw, home_of, screws_of
from derive.names import free

LETTERS = {"omega": ("omega", "w", "n"), "q": ("q", "u", "b"), "S": ("S", "xi"), "M": ("M", "T_home")}
NOTHING, T_BASE = Symbol("0"), Symbol("T_base")  # three zeros; the pose of the base
PITCH = Symbol("h_i")
DIFFERENCES = 1e-8
NAMED = ("exponential", "home", "twist")  # rules of the lines that are results


class ScrewsTold(Record):
    axes: Phrase  # what they are described by
    twists: Phrase
    pitch: Phrase | None  # what it is of each joint that has one
    law: Phrase | None  # what the exponential is of
    base: bool
    home: str  # a step
    motions: Phrase  # what moves what
    product: str  # a step
    order: Phrase | None  # of the factors


@dataclass(frozen=True)
class Exponentials:
    """A robot of screws written out up to row `last`; `whole` goes on to the end-effector. `frames` calls the
    motion of joint i T_i^{i-1}: the frame of the base, fixed to link i at zero, is its frame i. What the base
    itself adds belongs to T_1^0, so the motion of joint 1 alone is then E_1."""

    problem: Problem
    robot: Robot
    last: int
    whole: bool
    frames: bool = True
    called: Symbol | None = None

    @property
    def name(self) -> Symbol:
        """What the pose is called."""
        return self.called or Symbol(f"T_{end_frame(self.robot) if self.whole else self.last}^0")

    @cached_property
    def screws(self) -> tuple[Screw, ...]:
        return screws_of(self.robot)[: self.last]

    @cached_property
    def pose(self) -> ScalarMatrix:
        """T (4 by 4) in normal form."""
        motions = (screw.exponential for screw in self.screws)
        T = reduce(ScalarMatrix.__matmul__, motions, composed(self.robot.base))
        return T @ home_of(self.robot) if self.whole else T

    @cached_property
    def letters(self) -> dict[str, str]:
        """What directions, points, twists and the home pose are called: letters that begin no other name."""
        beginnings = {name.rstrip("0123456789").rstrip("_") for name in self.problem.taken}
        return {letter: free(beginnings, *names) for letter, names in LETTERS.items()}

    def lines(self, work: Work) -> Work:
        """The axes and their points, the twists, the home pose, the exponentials, and their product."""
        work = work.knowing({NOTHING: column((ZERO, ZERO, ZERO))})
        for screw in self.screws:
            work = work.line(self._name("omega", screw.i), value=screw.w, rule="screw-axis")
            if turns(screw):
                work = work.line(self._name("q", screw.i), value=screw.q, rule="screw-axis")
        for screw in self.screws:
            pitch = screw.row.pitch if screw.h else None
            formula = self._twist(screw.i, screw.row.slide, pitch)
            work = work.line(self._name("S", screw.i), formula, value=screw.S, rule="twist")
        factors: list[Expr] = []
        if self.robot.base:
            factors.append(T_BASE)
            work = work.line(T_BASE, value=composed(self.robot.base), rule="motion")
        if self.whole:
            work = work.line(self.letters["M"], value=home_of(self.robot), rule="home")
        if any(map(turns, self.screws)):
            helical = any(screw.h for screw in self.screws)
            work = work.showing(exponential_law(self.problem.taken, helical))
        for screw in self.screws:
            factors.append(motion := self._motion(screw))
            E = screw.exponential
            work = work.knowing({motion: self.problem.readable_matrix(E)})
            work = work.line(self._frame(screw.i), motion, value=E, rule="exponential")
            if screw.i == 1 and self.last > 1 and self.frames and self.robot.base:
                stands = composed(self.robot.base) @ E
                work = work.line("T_1^0", T_BASE * motion, value=stands, rule="exponential")
        factors += [Symbol(self.letters["M"])] if self.whole else []
        return product_lines(work, self.name, tuple(factors), self.pose)

    def proved(self, work: Work) -> Work:
        """With the claims that each matrix is the exponential: it solves dE/dq = [S] E, and agrees with the
        series."""
        for screw in self.screws:
            E, by = screw.exponential, screw.row.by
            for name in sorted(free_symbols(by) & set(self.problem.subject.variables)):
                rate = normal(by).diff(name)
                size = "" if rate == 1 else "-" if rate == -1 else f"dphi_{screw.i}/d{name} "
                holds = E.diff(name) == (screw.bracket @ E).scaled(rate)
                work = work.law("derivative", holds, i=screw.i, name=name, size=size)
            series = partial(_by_series, screw)
            work = work.agrees("exponential-series", self.problem.symbols, E, series, i=screw.i)
        return work.claim(self.sorted_right(self.told()), route("twist-of-any-screw", self._twists()))

    def _twists(self) -> Iterator[bool]:
        """Whether the laws that are told hold of a screw of numbers, by how it begins to move."""
        import numpy as np

        about, k, q = self.told().twists.about, np.array([2.0, -1.0, 2.0]) / 3, np.array([0.3, 0.5, -0.4])
        h = 0.7 if about["helical"] else 0.0
        ahead, behind = (helix(k, q, by, h) for by in (STEP, -STEP))
        D = (ahead - behind) / (2 * STEP)
        names: dict[Expr, Any] = {
            self._name("omega", "i"): k[:, None], self._name("q", "i"): q[:, None],
            NOTHING: np.zeros((3, 1)), PITCH: h,
        }  # fmt: skip
        twists = {"turn": [*D[:3, 3], *vee(D)], "slide": [*k, 0.0, 0.0, 0.0]}
        for name, twist in twists.items():
            law = about[name]
            yield (
                isinstance(law, Relation)
                and isinstance(law.right, TREES)
                and close(valued(law.right, names), twist, DIFFERENCES)
            )

    def told(self) -> ScrewsTold:
        """What the words read."""
        turning, sliding = (tuple(s.i for s in self.screws if turns(s) == each) for each in (True, False))
        helical = tuple(screw.i for screw in self.screws if screw.h)
        S = self._name("S", "i")
        about: dict[str, Said] = {
            "direction": self._name("omega", "i"),
            "point": self._name("q", "i"),
            "turn": Relation(S, "=", self._twist("i", False, PITCH if helical else None)),
            "slide": Relation(S, "=", self._twist("i", True)),
            "pitch": PITCH,
            "pitches": self._pitches(),
            "sliding": sliding,
            "helical": helical,
        }
        several = len(self.screws) + self.whole + bool(self.robot.base) > 1
        order = Phrase("order-with-home" if self.whole else "order")
        framed = self.frames and self.last > 1 and not self.robot.base
        motions = "motions-of-frames" if framed else "motions"
        return ScrewsTold(
            axes=Phrase(_of(turning, sliding, "axes-of-turns", "axes-of-slides", "axes-of-both"), about),
            twists=Phrase(self._twisted(turning, sliding, helical), about),
            pitch=Phrase("pitch", about) if helical else None,
            law=_law(bool(helical)) if turning else None,
            base=bool(self.robot.base),
            home=self.letters["M"] if self.whole else "",
            motions=Phrase("coupled-motions" if self.problem.subject.coupled else motions),
            product=self.name.name if several else "",
            order=order if several else None,
        )

    def sorted_right(self, told: ScrewsTold) -> Claim:
        """That joints turn, slide or advance as is told, by their twists (6 by 1)."""
        halves = {
            s.i: (s.S.block(slice(0, 3), slice(None)), s.S.block(slice(3, 6), slice(None)))
            for s in self.screws
        }
        sliding = tuple(i for i, (_, w) in halves.items() if not w)
        helical = tuple(i for i, (v, w) in halves.items() if (w.T @ v)[0, 0])
        said = told.pitch.about["helical"] if told.pitch else ()
        right = told.twists.about["sliding"] == sliding, said == helical
        pitches = (each.right for each in self._pitches())
        ours = (self.problem.readable((w.T @ v)[0, 0]) for v, w in (halves[i] for i in helical))
        return route("joint-sorts", (*right, [*pitches] == [*ours]))

    def _pitches(self) -> tuple[Relation, ...]:
        """h_1 = h of each joint that advances as it turns."""
        return tuple(
            Relation(Symbol(f"h_{s.i}"), "=", self.problem.readable(s.h)) for s in self.screws if s.h
        )

    @staticmethod
    def _twisted(turning: tuple[int, ...], sliding: tuple[int, ...], helical: tuple[int, ...]) -> str:
        """The key of the phrase about the twists."""
        if helical:
            return "advances-and-slides" if sliding else "advances"
        return _of(turning, sliding, "turns", "slides", "turns-and-slides")

    def _name(self, letter: str, i: int | str) -> Symbol:
        return Symbol(f"{self.letters[letter]}_{i}")

    def _twist(self, i: int | str, slide: bool, pitch: Expr | None = None) -> Matrix:
        """S_i = (q_i x omega_i, omega_i), or (omega_i, 0) of a slide."""
        w, q = self._name("omega", i), self._name("q", i)
        if slide:
            return Matrix(((w,), (NOTHING,)))
        along = () if pitch is None else (multiply(pitch, w),)
        return Matrix(((total(cross(q, w), *along),), (w,)))

    def _motion(self, screw: Screw) -> Indexed:
        """e^{[S_1] theta1}."""
        twist = Call("bracket", (self._name("S", screw.i),))
        return Indexed("e", (), (multiply(twist, screw.row.by),))

    def _frame(self, i: int) -> Symbol:
        """What that motion is called: T_1^0, or E_1 where that is no frame, or not yet: where the base or the
        home pose still belongs to T_1^0."""
        more = i == 1 and (bool(self.robot.base) or (self.whole and self.last == 1))
        return Symbol(f"T_{i}^{i - 1}") if self.frames and not more else Symbol(f"E_{i}")


def _law(helical: bool) -> Phrase:
    """What it is of: a rotation about a line, or a screw motion along it."""
    point = Symbol("q")
    if helical:
        return Phrase("law-with-pitch", {"pitch": Symbol("h"), "point": point})
    return Phrase("law", {"point": point})


def _of(turning: tuple[int, ...], sliding: tuple[int, ...], turns: str, slides: str, both: str) -> str:
    """Which of three keys says what joints there are."""
    return both if turning and sliding else turns if turning else slides


def turns(screw: Screw) -> bool:
    """Whether the joint turns, with a pitch or without."""
    return not screw.row.slide


def _by_series(screw: Screw, at: Point) -> Any:
    import numpy as np

    return exponential(np.array(matrix_numbers(screw.bracket, at)) * number(screw.row.by, at))
