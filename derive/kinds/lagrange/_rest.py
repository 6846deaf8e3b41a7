"""A system at rest: its inputs, and what its equations come to where nothing moves."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from derive.algebra.normal import normal
from derive.algebra.scalar import Scalar
from derive.derivation import Derivation
from derive.errors import NotDerivable
from derive.expression import Expr, Symbol, free_symbols
from derive.kinds.lagrange._model import Model
from derive.kinds.problem import Problem, expressions
from derive.mechanics.lagrangian import TIME


def inputs_of(model: Model) -> tuple[str, ...]:
    """Names that stand in the generalised forces and nowhere else, in their order. A symbol declared positive
    is a parameter, and so is the coefficient of a rate, or of the coordinate that its force drives: friction
    and springs."""
    system, problem = model.system, model.problem
    elsewhere = [*expressions(system.bodies), system.kinetic, system.potential, system.dissipation]
    elsewhere += system.gravity
    taken = frozenset().union(*map(free_symbols, elsewhere), system.coordinates, system.rates)
    taken |= {TIME, *problem.where} | {n for n, what in problem.assumptions.items() if what == "positive"}
    found = dict.fromkeys(name for _, tree in system.forces for name in sorted(free_symbols(tree) - taken))
    return tuple(name for name in found if not _is_coefficient(model, name))


def _is_coefficient(model: Model, name: str) -> bool:
    """Whether it multiplies a rate or the coordinate of its own force, or stands in a function of time."""
    for q, force in model.forces.items():
        for powers, _ in force.ring.terms(force.numerator):
            letters = [force.ring.letters(generator) for generator, _ in powers]
            if not any(name in each for each in letters):
                continue
            beside = {generator for generator, _ in powers}
            if beside & {q, *model.system.rates} or any({name, TIME} <= each for each in letters):
                return True
    return False


def require_steady(given: Mapping[str, Expr], moving: Iterable[str], place: str = "inputs") -> None:
    """Raises NotDerivable for a value that changes: the equations hold such a thing only as a force."""
    for name, value in given.items():
        if found := sorted(free_symbols(value) & set(moving)):
            raise NotDerivable(
                f"{name} under {place}: depends on {found[0]}; write what changes into forces: itself", place
            )


def there(model: Model, value: Scalar, at: Mapping[Expr, Expr]) -> Scalar:
    """A value at the state of rest; through its tree, for angles stand inside sines."""
    return normal(model.problem.readable(value), {**model.moving, **at})


def surely_positive(model: Model) -> set[str]:
    """Bare letters for masses, moments of inertia and the acceleration of gravity."""
    trees = [part for body in model.system.bodies for part in (body.mass, body.inertia)]
    names = {tree.name for tree in trees if isinstance(tree, Symbol)}
    return names | ({"g"} if model.system.gravity else set())


def equations(problem: Problem) -> Derivation:
    """The equations of motion, as they were asked for if they were."""
    kind = "equations-of-motion"
    asked = next((options for name, options in problem.questions if name == kind), None)
    return problem.ask(kind) if asked is None else problem.answer(kind, asked)
