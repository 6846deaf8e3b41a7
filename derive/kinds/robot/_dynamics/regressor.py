"""The regressor of an arm in normal form: its columns, its parameters, and which of them are enough."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal, normal_matrix
from derive.algebra.scalar import Scalar
from derive.algebra.solving.linear_dependence import dependencies
from derive.errors import NotDerivable, TooManyTerms
from derive.expression import ZERO, Call, Expr, Indexed, Symbol, column, free_symbols, number
from derive.kinds.problem import Problem
from derive.kinds.robot._chain import chain_of
from derive.kinds.robot._dynamics.bodies import Weighted, weighted
from derive.kinds.robot._dynamics.drives import friction_terms, moving
from derive.mechanics.chain import Chain
from derive.mechanics.drives import Friction
from derive.mechanics.dynamics import gravity_of
from derive.mechanics.joint_loads import reflected
from derive.mechanics.poses import position_part, rotation_part
from derive.mechanics.regressor import NAMES, columns, parameters_of, reference
from derive.mechanics.robot import Link

MOST_TERMS = 100_000  # of all columns


@dataclass(frozen=True, slots=True)
class Standard:
    """A parameter that acts on the torques: its name, its value and its column in Y (n by 1)."""

    name: Indexed
    value: Scalar
    column: ScalarMatrix


@dataclass(frozen=True, slots=True)
class Base:
    """A parameter of the smallest set: what it gathers (names with their weights, its own first), its
    value, and its column."""

    name: Symbol
    parts: tuple[tuple[Indexed, Scalar], ...]
    value: Scalar
    column: ScalarMatrix


def standard_parameters(problem: Problem) -> tuple[Standard, ...]:
    """Of bodies, rotors and frictions, those that are not zero and act, in the order of the links. One that
    is zero is left out as known to be so: counted, it could make other columns combinations of more.

    Raises NotDerivable where a body or the friction of a joint changes with a joint variable, TooManyTerms
    where there are more than anyone waits for.
    """
    _refuse_changing(problem)
    found = chain_of(problem)
    gravity = normal_matrix(column(gravity_of(problem.subject)))
    bodies = {body.i: body for body in weighted(problem, found)}
    parameters: list[Standard] = []
    terms = 0
    for i, link in enumerate(problem.subject.links, 1):
        for each in _of_body(found, bodies[i], gravity) if i in bodies else ():
            parameters.append(each)
            terms += sum(len(entry.numerator) for entry in each.column.entries)
            _refuse_vast(terms)
        parameters += _of_rotor(problem, link)
    return (*parameters, *_of_friction(problem))


def referred_to(problem: Problem) -> str:
    """Which points the parameters of bodies refer to: of every link the origin of the frame before or its own
    one; "either" where links that turn have the first and links that slide the second; else the axis."""
    found, robot = chain_of(problem), problem.subject
    links = [(i, link.joint) for i, link in enumerate(robot.links, 1) if link.body]
    own = {i for i, _ in links if reference(found, i) == position_part(found.T[i])}
    before = {i for i, _ in links if reference(found, i) == position_part(found.T[i - 1])}
    every = {i for i, _ in links}
    if before == every:
        return "before"
    if own == every:
        return "own"
    turning = {i for i, joint in links if joint == "revolute"}
    return "either" if turning <= before and every - turning <= own else "axis"


def has_zeros(problem: Problem) -> bool:
    """Whether a link has a parameter that is zero, all of them without a body."""
    found = chain_of(problem)
    bodies = {body.i: body for body in weighted(problem, found)}
    links = range(1, len(problem.subject.links) + 1)
    return any(i not in bodies or not all(_values(found, bodies[i]).values()) for i in links)


def _refuse_changing(problem: Problem) -> None:
    robot = problem.subject
    rubbing = (tree for each in friction_terms(robot) for tree in each)
    if robot.shifting or any(not free_symbols(tree).isdisjoint(robot.variables) for tree in rubbing):
        raise NotDerivable(
            "a joint variable stands in the center of mass, the inertia or the friction of a link, so that "
            "its parameters are no constants and no regressor has them"
        )


def _refuse_vast(terms: int) -> None:
    if terms > MOST_TERMS:
        raise TooManyTerms(
            f"the regressor of this arm has more than {MOST_TERMS} terms; give numbers to lengths and "
            "twists, quarter turns where they will do"
        )


def _of_body(found: Chain, body: Weighted, gravity: ScalarMatrix) -> Iterator[Standard]:
    values = _values(found, body)
    wanted = [name for name in NAMES if values[name]]
    for part in columns(found, body.i, gravity, wanted):
        yield Standard(_name(part.name, body.i), values[part.name], ScalarMatrix.column(part.column))


def _values(found: Chain, body: Weighted) -> dict[str, Scalar]:
    """The ten parameters of a body."""
    com = rotation_part(found.T[body.i]).T @ (body.motion.com - reference(found, body.i))
    return parameters_of(body.motion.mass, com, body.motion.inertia)


def _of_rotor(problem: Problem, link: Link) -> list[Standard]:
    if reflected(link.motor) == ZERO or link.variable is None:
        return []
    return [_alone(problem, "IA", link, reflected(link.motor), Symbol(f"{link.variable}_ddot"))]


def _of_friction(problem: Problem) -> list[Standard]:
    """Viscous and Coulomb friction of every joint."""
    found = []
    for link in moving(problem.subject):
        friction, rate = link.friction or Friction(), Symbol(f"{link.variable}_dot")
        if friction.viscous != ZERO:
            found.append(_alone(problem, "FV", link, friction.viscous, rate))
        if friction.coulomb != ZERO:
            found.append(_alone(problem, "FS", link, friction.coulomb, Call("sign", (rate,))))
    return found


def _alone(problem: Problem, name: str, link: Link, value: Expr, factor: Expr) -> Standard:
    """A parameter of one joint: its column holds one factor."""
    k = problem.subject.variables.index(link.variable or "")
    entries = [normal(factor) if j == k else Scalar.of(0) for j in range(len(problem.subject.variables))]
    return Standard(
        _name(name, problem.subject.links.index(link) + 1), normal(value), ScalarMatrix.column(entries)
    )


def _name(letters: str, i: int) -> Indexed:
    return Indexed(letters, (number(i),))


def dependent(problem: Problem, parameters: Sequence[Standard]) -> dict[int, dict[int, Scalar]]:
    """Which columns are combinations of columns before them, with what weights; friction stands alone."""
    variables = problem.subject.variables
    varying = {f"{name}{dots}" for name in variables for dots in ("", "_dot", "_ddot")}
    rigid = [part.column.entries for part in parameters if part.name.base not in ("FV", "FS")]
    return dependencies(rigid, varying)


def base_parameters(
    parameters: Sequence[Standard], made_of: Mapping[int, Mapping[int, Scalar]]
) -> tuple[Base, ...]:
    """The independent columns, each with its own parameter and the shares of those it stands for; these
    may cancel for the bodies given."""
    found: list[Base] = []
    for i, own in enumerate(parameters):
        if i in made_of:
            continue
        shares = [(parameters[j].name, weights[i]) for j, weights in made_of.items() if i in weights]
        value = own.value
        for j, weights in made_of.items():
            if i in weights:
                value = value + weights[i] * parameters[j].value
        name = Symbol(f"Theta_{len(found) + 1}")
        found.append(Base(name, ((own.name, Scalar.of(1)), *shares), value, own.column))
    return tuple(found)
