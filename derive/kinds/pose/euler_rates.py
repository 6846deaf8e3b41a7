"""How the rates of three angles and the angular velocity belong together, and where they do not."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers
from derive.algebra.scalar import Scalar
from derive.derivation import Branch, Claim, Derivation, PageFacts, Phrase, Result, Step
from derive.errors import NotDerivable
from derive.expression import (
    ZERO,
    Call,
    Expr,
    Indexed,
    Matrix,
    Product,
    Relation,
    Symbol,
    column,
    free_symbols,
    multiply,
    number,
)
from derive.kinds.checks import agreement, law, links
from derive.kinds.fields import Name, OptionsModel
from derive.kinds.pose.euler_angles import DEFAULTS, known_convention
from derive.kinds.problem import Problem
from derive.mechanics.elementary import factor_name, rotation_matrix
from derive.mechanics.euler import SIGNS, Convention, Euler
from derive.mechanics.euler_rates import rate_matrix
from derive.mechanics.motion import Motion
from derive.mechanics.poses import UNIT, skew

SUBJECTS = ("motion", "frames", "robot")
RESULTS = {
    "T": "omega = T times the rates of the angles (3 by 3), in the order of the angles",
    "det": "its determinant",
    "rates": "the rates of the angles for a given omega (3), where det is not zero",
    "singular": "the values of the middle angle at which det vanishes",
}
EXAMPLE = """\
title: Rates of Euler angles
problems:
- motion:
  - {rotate: z, by: phi}
  - {rotate: y, by: theta}
  - {rotate: z, by: psi}
  find: euler-rates
  convention: ZYZ
"""
T, OMEGA = Symbol("T"), Symbol("omega")
STEP = 1e-6  # of differences
DIFFERENCES = 1e-6


class Options(OptionsModel):
    """`convention` and `angles` as of euler-angles; `in`: the axes of omega, those of the `base` (the world)
    or of the `body`."""

    convention: Annotated[str, AfterValidator(known_convention)] = "ZYX"
    angles: tuple[Name, Name, Name] | None = None
    frame: Literal["base", "body"] = Field("base", alias="in")


class Facts(PageFacts):
    body: bool
    axes: tuple[str, ...]  # steps
    zeros: tuple[tuple[Symbol, Expr], ...]  # values of the middle angle
    outer: tuple[Symbol, Symbol]


def derive(subject: Any, options: Options, problem: Problem) -> Derivation:
    """Each column of T is the axis about which its angle turns (Siciliano et al., section 3.6)."""
    euler = Euler(Convention.of(options.convention), _names(options, problem))
    found = _Rates(euler, options.frame, problem)
    steps = found.steps()
    definitions = found.definitions()
    claims = (*links(steps, {**problem.names, **definitions}), *found.laws(), found.second_route())
    results: dict[str, Result] = {
        "T": found.written,
        "det": problem.readable(found.det),
        "rates": problem.readable_matrix(found.solved),
        "singular": found.singular(),
    }
    return Derivation("euler-rates", steps, results, claims, definitions, facts=found.facts())


def _names(options: Options, problem: Problem) -> tuple[str, str, str]:
    """The angles as the author names them, or as a motion of the same sequence does; else free names.

    Raises NotDerivable where two of them are called alike.
    """
    if options.angles is not None:
        if len(set(options.angles)) < 3:
            raise NotDerivable("the three angles need three different names")
        return options.angles
    taken = problem.taken
    own = _of_motion(problem.subject, Convention.of(options.convention))
    return own or next((names for names in DEFAULTS if not taken & set(names)), DEFAULTS[-1])


def _of_motion(subject: Any, convention: Convention) -> tuple[str, str, str] | None:
    """The angles of a motion that makes just the rotations of a convention."""
    if not isinstance(subject, Motion) or len(subject.moves) != 3:
        return None
    axes = tuple(move.axis for move in subject.moves)
    about = {move.about for move in subject.moves[1:]}
    turns = [move.by for move in subject.moves if move.kind == "rotate"]
    names = [angle.name for angle in turns if isinstance(angle, Symbol) and free_symbols(angle)]  # pi is none
    if axes != convention.axes or about != {convention.about} or len(set(names)) < 3:
        return None
    return names[0], names[1], names[2]


class _Rates:
    """T of a convention, and its inverse."""

    def __init__(self, euler: Euler, seen_from: Literal["base", "body"], problem: Problem) -> None:
        self.euler, self.seen_from, self.problem = euler, seen_from, problem
        self.matrix = rate_matrix(euler, seen_from)
        self.written = problem.readable_matrix(self.matrix)
        self.det = self.matrix.det()
        self.omega = ScalarMatrix.column([Scalar.symbol(f"omega_{axis}") for axis in "xyz"])
        self.inverse = self.matrix.inverse()
        self.solved = self.inverse @ self.omega

    @property
    def factors(self) -> tuple[Indexed, ...]:
        moves = self.euler.factors
        return tuple(factor_name(move, Symbol(str(move.axis)), ("R", "")) for move in moves)

    @property
    def rates(self) -> Matrix:
        return column(Symbol(f"{name}_dot") for name in self.euler.names)

    def steps(self) -> tuple[Step, ...]:
        """The axes, T, its determinant, and the rates by its inverse."""
        axes = tuple(self._axis(name) for name in self.euler.names)
        block = Matrix((tuple(Symbol(f"t_{name}") for name in self.euler.names),))
        filled = Product((self.written, self.rates))
        read = self.problem.readable_matrix
        omega = column(Symbol(f"omega_{axis}") for axis in "xyz")
        return (
            *axes,
            Step("T", (T, block, self.written), "rate-matrix"),
            Step("omega", (OMEGA, Product((T, self.rates)), filled), "law"),
            Step("det", (Call("det", (T,)), self.problem.readable(self.det)), "determinant"),
            Step("rates", (self.rates, Product((Call("inverse", (T,)), omega)), read(self.solved)), "law"),
        )

    def _axis(self, name: str) -> Step:
        """The axis of one rotation, carried by those before it in the product."""
        place = self.euler.outer.index(name)
        unit = column(map(number, UNIT[str(self.euler.factors[place].axis)]))
        if self.seen_from == "base":
            before: tuple[Expr, ...] = self.factors[:place]
        else:
            before = tuple(Call("transpose", (factor,)) for factor in self.factors[:place:-1])
        k = self.euler.names.index(name)
        value = self.problem.readable_matrix(self.matrix.columns(k))
        chain = (Symbol(f"t_{name}"), multiply(*before, unit), *((value,) if before else ()))
        return Step(f"t_{name}", chain, "axis")

    def definitions(self) -> dict[Expr, Expr]:
        moves = zip(self.euler.factors, self.factors, strict=True)
        found: dict[Expr, Expr] = {factor: rotation_matrix(str(move.axis), move.by) for move, factor in moves}
        found |= {Symbol(f"t_{name}"): self._axis(name).result for name in self.euler.names}
        return {**found, T: self.written}

    def singular(self) -> tuple[Branch, ...]:
        """Where the middle angle makes det vanish."""
        middle = self.euler.outer[1]
        cases = [self.euler.singular(sign) for sign in SIGNS]
        singular = Phrase("singular-where", {"zero": Relation(Call("det", (T,)), "=", ZERO)})
        return tuple(Branch({middle: case.middle}, (singular,)) for case in cases)

    def laws(self) -> tuple[Claim, ...]:
        """S(t_i) = dR/dangle R^T for each angle, T T^-1 = 1, and det zero where it is said to be."""
        R, holds = self.euler.matrix, True
        for k, name in enumerate(self.euler.names):
            rate = R.diff(name) @ R.T if self.seen_from == "base" else R.T @ R.diff(name)
            holds &= rate == skew(self.matrix.columns(k))
        middle = self.euler.outer[1]
        zeros = all(self._det_at(middle, case.values[middle]) == 0 for case in self.singular())
        return (
            law("angular-velocities", holds),
            law("inverse", self.matrix @ self.inverse == ScalarMatrix.identity(3)),
            law("singular", zeros),
        )

    def _det_at(self, middle: str, value: Expr) -> Scalar:
        return normal(self.problem.readable(self.det), {Symbol(middle): value})

    def second_route(self) -> Claim:
        """omega by differences of rotations composed in numbers."""
        from derive.kinds.pose._euler_checks import composed

        def differences(point: Mapping[str, float]) -> Any:
            import numpy as np

            R, columns = composed(self.euler, point), []
            for name in self.euler.names:
                ahead, behind = (
                    composed(self.euler, {**point, name: point[name] + h}) for h in (STEP, -STEP)
                )
                rate = (ahead - behind) / (2 * STEP)
                S = rate @ R.T if self.seen_from == "base" else R.T @ rate
                columns.append([S[2, 1], S[0, 2], S[1, 0]])
            return np.array(columns).T

        return agreement(
            "differences",
            self.euler.names,
            lambda point: matrix_numbers(self.matrix, point),
            differences,
            DIFFERENCES,
        )

    def facts(self) -> Facts:
        middle = self.euler.outer[1]
        return Facts(
            body=self.seen_from == "body",
            axes=tuple(f"t_{name}" for name in self.euler.names),
            zeros=tuple((Symbol(middle), case.values[middle]) for case in self.singular()),
            outer=(Symbol(self.euler.outer[0]), Symbol(self.euler.outer[2])),
            short_names=self.euler.names,
        )
