"""The equations of motion by the recursion of Newton and Euler, line by line, held against Euler-Lagrange."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal_matrix
from derive.algebra.numbers.floats import numbers
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation, PageFacts, Phrase, Record, Step
from derive.errors import NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol, column
from derive.kinds.checks import flat, route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.problem import Problem
from derive.kinds.robot._by_index import EVERY, Meaning, by_index
from derive.kinds.robot._chain import LINKS_ALONE, chain_of
from derive.kinds.robot._dynamics.arm import Arm
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.body_steps import inertia_steps
from derive.kinds.robot._dynamics.drives import with_rotors
from derive.kinds.robot._dynamics.recursion import Line, Recursion, rotation
from derive.kinds.robot._dynamics.turned_frames import hold_in_any_frames
from derive.kinds.robot._families import of_each, said_of_each
from derive.kinds.robot._units import of_joints
from derive.kinds.work import Work
from derive.mechanics.chain import Chain
from derive.mechanics.dynamics import gravity_of, rate_column
from derive.mechanics.newton_euler import LinkBody, NewtonEuler
from derive.mechanics.oracle.heavy import Heavy
from derive.mechanics.robot import Robot

NEEDS = ("bodies",)
CLAIMS = ("inertia", "christoffel", "gravity", "motion-of-each-body", "names", "each-link")
CLAIMED = {"tau": "motion-of-each-body"}  # by the motion of each body; of a long arm no line has it
measures = of_joints("tau", effort=True)


BASE = Symbol("o_0_ddot")
MOST_TWICE = 16  # operations of a joint force that is written down twice
OF_EACH_LINK = ("omega_{}", "omega_{}_dot", "o_{}_ddot", "f_{}", "mu_{}")
CONSTANTS = {"e": "constant-e", "r": "constant-r", "r_c": "constant-r_c", "p": "constant-p"}


Vector = Callable[[Heavy, int, Any], Any]  # of link i, in the base frame


def _in_link(vector: Vector, shift: int = 0) -> Meaning:
    """A vector as it is told, in the frame of the link, or of one before it."""
    return lambda arm, i, said: arm.pose(str(int(i) + shift))[:3, :3].T @ vector(arm, int(i), said)


def _rise(frame: str) -> Vector:
    """The acceleration of its origin, the base accelerating upwards for gravity."""
    return lambda arm, i, _: arm.courses[frame.format(i)].a - arm.oracle.gravity(arm.at)


def _out(arm: Heavy, i: int, said: Any) -> Any:
    """From the origin of the frame before to the nearest point of the axis, of a slide to its own frame."""
    before, o = arm.pose(str(i - 1)), arm.pose(str(i))[:3, 3]
    if arm.oracle.robot.links[i - 1].joint != "revolute":
        return o - before[:3, 3]
    return arm.on_axis(i, before[:3, :3] @ said + before[:3, 3]) - before[:3, 3]


@dataclass(frozen=True)
class _Axis:
    """The points of the axes that moments are about: p_i as told, from the origin of the frame before; where
    it is not told, that origin."""

    told: Mapping[Expr, Expr]

    def point(self, arm: Heavy, i: int) -> Any:
        """In the base frame (3)."""
        before, p = arm.pose(str(i - 1)), self.told.get(Symbol(f"p_{i}"))
        there = [0, 0, 0] if p is None else [*flat(numbers(p, arm.at))]
        return before[:3, :3] @ there + before[:3, 3]

    def reach(self, arm: Heavy, i: int, _: Any) -> Any:
        """From the point to the origin of the frame: p_i and r_i go from one origin to the next."""
        return arm.pose(str(i))[:3, 3] - self.point(arm, i)

    def moment(self, arm: Heavy, i: int, _: Any) -> Any:
        """That of all loads from link i on, about the point."""
        return arm.moment_handed(i, self.point(arm, i))


def _meanings(told: Mapping[Expr, Expr]) -> Mapping[str, Meaning]:
    """Of the names of the recursion, in whose lines p_i stand as told."""
    axis = _Axis(told)
    return {
        **EVERY,
        r"e_(\d+)": _in_link(lambda arm, i, _: arm.axis(i)),
        r"p_(\d+)": _in_link(_out, -1),
        r"r_(\d+)": _in_link(axis.reach),
        r"r_c(\d+)": _in_link(lambda arm, i, _: arm.pose(f"c{i}")[:3, 3] - arm.pose(str(i))[:3, 3]),
        r"omega_(\d+)": _in_link(lambda arm, i, _: arm.courses[str(i)].omega),
        r"omega_(\d+)_dot": _in_link(lambda arm, i, _: arm.courses[str(i)].alpha),
        r"o_(\d+)_ddot": _in_link(_rise("{}")),
        r"o_c(\d+)_ddot": _in_link(_rise("c{}")),
        r"F_(\d+)": _in_link(lambda arm, i, _: arm.force(i)),
        r"N_(\d+)": _in_link(lambda arm, i, _: arm.moment(i)),
        r"f_(\d+)": _in_link(lambda arm, i, _: arm.handed(i)),
        r"mu_(\d+)": _in_link(axis.moment),
    }


class OfLink(Record):
    link: int


class Facts(PageFacts):
    laws: Phrase
    in_names: Phrase | None
    constants: tuple[Phrase, ...]  # what there is of each link
    about: Phrase  # which point moments are
    one: bool  # inertia matrix


def derive(robot: Robot, options: Options, problem: Problem) -> Derivation:
    """Out with the motion, back with the forces (Siciliano et al., section 7.5; Craig, section 6.5).

    Raises NotDerivable where a row moves by more than its own variable, or a body in its link.
    """
    if robot.coupled or robot.shifting:
        raise NotDerivable(
            "the recursion takes joints that each move one row, and bodies that are fixed to their links; "
            "find: dynamics has the equations of motion of this arm"
        )
    arm, tau = Arm(problem), problem.ask("dynamics").matrix("tau")
    bodies = weighted(problem, chain_of(problem))
    sweeping = _sweeping(arm, bodies)
    recursion = _swept(arm, sweeping, bodies)
    work = Work(problem, uses=(problem.ask("forward-kinematics"),), aside=arm.moments)
    work = work.knowing({rotation(i): work.readable(row.R) for i, row in enumerate(sweeping.rows, 1)})
    work = work.knowing({body.I: body.matrix for body in bodies})
    work = work.linked() if arm.long else work  # in names there is nothing to compare
    constants = [*recursion.constants()]
    for line in constants:
        work = work.line(line.name, value=line.value, rule=line.rule)
    base = ScalarMatrix.column(sweeping.at_base(_gravity(problem)))
    work = work.showing(*inertia_steps(problem, bodies)).line(BASE, value=base, rule="base")
    torques = {Symbol(f"tau_{k}"): entry for k, (entry,) in enumerate(tau.rows, 1)}
    lines = (*recursion.outward(), *recursion.inward())
    work = work.claim(route("any-frames", hold_in_any_frames(work, lines, bodies)))
    for line in lines:
        work = _in_names(work, line) if arm.long else _written(work, line, torques, recursion.handed_on(line))
    work = work.law("each-link", _lines_of_each(robot, {step.name for step in work.steps}))
    facts = Facts(
        laws=Phrase("laws-ask" if arm.long else "laws-give", {"F": Symbol("F_i"), "N": Symbol("N_i")}),
        in_names=Phrase("in-names") if arm.long else None,
        about=Phrase("about-points", {"p": of_each("p")})
        if any(each.name.name.startswith("p_") for each in constants)
        else Phrase("about-origins"),
        constants=said_of_each(CONSTANTS, (line.name for line in constants)),
        one=sum(body.turns for body in bodies) == 1,
    )
    work = arm.moved(_same_as_lagrange(work, arm, sweeping), tau)
    return by_index(work, {"tau": tau}, _meanings(work.definitions)).answer(
        "newton-euler", {"tau": tau}, facts, unread=LINKS_ALONE
    )


def _lines_of_each(robot: Robot, told: set[str]) -> Iterator[bool]:
    """Whether every link has its lines out and back, and every joint its force."""
    links, joints = range(1, len(robot.links) + 1), range(1, len(robot.variables) + 1)
    yield from (name.format(i) in told for i in links for name in OF_EACH_LINK)
    yield from (f"tau_{k}" in told for k in joints)


def _sweeping(arm: Arm, bodies: tuple[Weighted, ...]) -> NewtonEuler:
    """The arm with its bodies, ready for sweeps with rates by name."""
    problem, variables = arm.problem, arm.variables
    carried: list[LinkBody | None] = [None] * len(problem.subject.links)
    for body in bodies:
        carried[body.i - 1] = LinkBody(body.motion.mass, body.com, body.motion.inertia)
    moving = (*rate_column(variables).entries, *rate_column(variables, "ddot").entries)
    return NewtonEuler.of(_from_the_base(chain_of(problem)), carried, (*moving, *_gravity(problem)))


def _from_the_base(found: Chain) -> Chain:
    """With the base motion as part of the first row, so that frame 0 is that of the base."""
    base, (first, *others) = found.T[0], found.joints
    if first is not None:
        first = replace(first, before=base @ first.before)
    still = ScalarMatrix.identity(4).into(base.ring)
    local = (found.T[1], *found.T_local[1:])
    return replace(found, T_local=local, T=(still, *found.T[1:]), joints=(first, *others))


def _gravity(problem: Problem) -> tuple[Scalar, ...]:
    return normal_matrix(column(gravity_of(problem.subject))).entries


def _swept(arm: Arm, sweeping: NewtonEuler, bodies: tuple[Weighted, ...]) -> Recursion:
    """The sweep with rates by name; of a long arm with none, for its lines stay in names."""
    still = [Scalar.of(0)] * len(arm.variables)
    rates, rises = (
        still if arm.long else rate_column(arm.variables, dots).entries for dots in ("dot", "ddot")
    )
    swept = sweeping.sweep(rates, rises, _gravity(arm.problem))
    return Recursion(sweeping, swept, {body.i: body for body in bodies}, arm.problem.subject.links)


def _in_names(work: Work, line: Line) -> Work:
    """A line of a long arm."""
    return work.showing(Step(line.name.name, (line.name, line.formula), line.rule, OfLink(link=line.i)))


def _written(work: Work, line: Line, torques: Mapping[Symbol, Expr], on: tuple[int, Symbol] | None) -> Work:
    """A line with its value; a joint force ends by what Euler and Lagrange gave, and stands for the component
    of a moment that is handed `on` to it, where that is long."""
    value = end = work.readable(line.value)
    if on and isinstance(value, Matrix) and operations(value.rows[on[0]][0]) > MOST_TWICE:
        k, torque = on
        work = work.knowing({torque: torques[torque]})
        end = column(torque if i == k else entry for i, (entry,) in enumerate(value.rows))
    end = torques.get(line.name, end)
    formulas = () if line.formula == ZERO else (line.formula,)  # nothing in names adds up to it
    work = work.line(
        line.name,
        *formulas,
        value=end,
        rule=line.rule,
        facts=OfLink(link=line.i),
        spare=(end,) if formulas else (),
    )
    return work.knowing({line.name: value})


def _same_as_lagrange(work: Work, arm: Arm, sweeping: NewtonEuler) -> Work:
    """D, every c_ijk and g of the recursion are those of Euler and Lagrange."""
    problem, symbols, found = work.problem, arm.christoffel, sweeping.christoffel()
    g = problem.ask("gravity").matrix("g")
    held = problem.readable_matrix(ScalarMatrix.column(sweeping.gravity_torques(_gravity(problem))))
    work = work.law("inertia", with_rotors(sweeping.inertia_matrix(), problem.subject) == arm.D)
    work = work.law("christoffel", (found[ijk] == symbols[ijk] for ijk in symbols))
    return work.law("gravity", normal_matrix(held, problem.names) == normal_matrix(g))
