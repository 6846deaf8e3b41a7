"""What `figure: true` draws: the subject of a problem as a picture."""

from __future__ import annotations

from derive.control.system import System
from derive.derivation import Drawing
from derive.errors import NotDerivable
from derive.expression import ZERO
from derive.figures.arm_marks import Mark
from derive.figures.wish import Wish
from derive.kinds.problem import Problem
from derive.mechanics.frames import Frames
from derive.mechanics.lagrangian import LagrangianSystem
from derive.mechanics.linkages import FiveBar, FourBar, SliderCrank
from derive.mechanics.mobility import Mechanism
from derive.mechanics.motion import Motion
from derive.mechanics.robot import Robot

MASSES = frozenset(
    {"dynamics", "inertia-matrix", "gravity", "christoffel", "coriolis-matrices", "properties", "residual"}
)
NOTHING = Wish()
MOST_FRAMES = 8  # that one figure can show
DRAWN = frozenset(
    {"robot", "motion", "frames", "system", "motor", "lagrange"}
)  # the subjects that can be drawn


def explains(problem: Problem, solutions: bool) -> bool:
    """Whether a figure is drawn of a subject whose author said nothing of it. What a motion does is part of
    the answer: it is drawn with the solutions."""
    match problem.subject:
        case Robot():
            return True
        case Frames(frames=frames):
            return len(frames) <= MOST_FRAMES
        case LagrangianSystem() | Mechanism() | FourBar() | SliderCrank() | FiveBar():
            return True  # where it can be drawn
        case Motion():
            return solutions
        case _:
            return False


def _marks(problem: Problem, robot: Robot) -> list[Mark]:
    """The points that are asked about, and centers of mass where it is masses that matter."""
    from derive.figures.arm_marks import Mark, centers

    points = [getattr(options, "point", None) for _, options in problem.questions]
    asked = [point for point in points if point and point.link and any(part != ZERO for part in point.at)]
    marks = {
        point.at: Mark(point.link, point.at, "o_c", False)
        for point in asked
        if point.link <= len(robot.links)
    }
    return [
        *marks.values(),
        *(centers(robot) if any(find in MASSES for find, _ in problem.questions) else ()),
    ]


def figure_of(problem: Problem, wish: Wish = NOTHING) -> Drawing:
    """The subject drawn, in a pose that shows it. Raises NotDerivable."""
    match problem.subject:
        case Robot():
            from derive.figures import arm_sketch

            return arm_sketch.drawn(problem.subject, problem.where, wish, _marks(problem, problem.subject))
        case Motion():
            from derive.figures import motions

            return motions.of_motion(problem.subject, problem.where, wish)
        case Frames():
            from derive.figures import triads

            return triads.of_frames(problem.subject, problem.where, wish)
        case Mechanism():
            from derive.figures import linkages

            return linkages.drawn(problem.subject)
        case FourBar() | SliderCrank():
            from derive.figures import bars

            return bars.drawn(problem.subject)
        case FiveBar():
            from derive.figures import bars

            return bars.five_bar(problem.subject)
        case LagrangianSystem():
            from derive.figures import lagrangians

            return lagrangians.drawn(problem.subject, problem.where)
        case System():
            from derive.figures.loops import drawn_blocks
            from derive.kinds.system._plant import plant

            solved = plant(problem, None, None)
            return drawn_blocks(problem.subject, solved.rational, solved.style)
        case _:
            raise NotDerivable(f"a {problem.name} is not drawn")
