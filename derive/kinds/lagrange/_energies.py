"""From positions over velocities to the energies and the Lagrangian, step by step."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.readable.operation_count import operations
from derive.algebra.scalar import Scalar
from derive.derivation import Step
from derive.expression import ZERO, Expr, Number, Product, Symbol, add, column, multiply, number, transpose
from derive.kinds.lagrange._equations import written_side
from derive.kinds.lagrange._model import Model
from derive.mechanics.lagrangian import MovingBody, rate, velocity

FEW = 3  # operations more
ORDER = {"position": 0, "velocity": 1, "spin": 1, "kinetic-of-body": 2, "kinetic": 2}


def energy_steps(model: Model) -> tuple[Step, ...]:
    """Positions, velocities, T, P and L."""
    letters = model.letters
    bodies = [step for k, body in enumerate(model.system.bodies, 1) for step in _body(model, body, k)]
    bodies.sort(key=lambda step: ORDER[step.rule])
    T = _total(model, letters.kinetic, model.kinetic, model.system.kinetic, "kinetic")
    P = _total(model, letters.potential, model.potential, model.system.potential, "potential")
    L = Symbol(letters.lagrangian)
    whole = written_side(model.lagrangian, model.system, model.problem)
    split = Symbol(letters.kinetic) - Symbol(letters.potential)
    return (*bodies, *T, *P, Step(L.name, (L, split, whole), "lagrangian"))


def _body(model: Model, body: MovingBody, k: int) -> Iterator[Step]:
    letters, problem = model.letters, model.problem
    r, v, T = (letters.of_body(letter, k) for letter in (letters.position, letters.velocity, letters.kinetic))
    place = ScalarMatrix.column(map(model.scalar, body.position))
    yield Step(r.name, (r, column(body.position)), "position")
    moved = velocity(place, model.system).entries
    speed = column(written_side(entry, model.system, problem) for entry in moved)
    yield Step(v.name, (v, speed), "velocity")
    parts: list[Expr] = [_half(body.mass, transpose(v) * v)]
    if body.inertia is not None and body.angle is not None:
        omega = letters.of_body(letters.spin, k)
        spin = written_side(rate(model.scalar(body.angle), model.system), model.system, problem)
        yield Step(omega.name, (omega, spin), "spin")
        parts.append(_half(body.inertia, omega**2))
    energy = written_side(model.kinetic[k - 1], model.system, problem)
    if letters.indexed or model.system.kinetic != ZERO:
        name = T if letters.indexed else Symbol(f"{letters.kinetic}_1")
        yield Step(name.name, (name, add(*parts), energy), "kinetic-of-body")
    else:
        yield Step(T.name, (T, add(*parts), energy), "kinetic")


def _half(factor: Expr, square: Expr) -> Expr:
    """1/2 m v^T v."""
    return multiply(number("1/2"), factor, *(square.factors if isinstance(square, Product) else (square,)))


def _total(model: Model, letter: str, parts: tuple[Scalar, ...], extra: Expr, rule: str) -> Iterator[Step]:
    """The sum over bodies and what was given besides; nothing where a step above said it."""
    problem, name = model.problem, Symbol(letter)
    bodies = len(model.system.bodies)
    total = written_side(sum(parts, Scalar.of(0)), model.system, problem)
    if rule == "kinetic" and bodies == 1 and extra == ZERO:
        return
    terms = _terms(model, letter, parts, rule)
    chain = [name, add(*terms, extra) if terms else extra, total]
    if rule == "potential" and bodies:
        chain[1] = add(*(_weight(model, body) for body in model.system.bodies), extra)
    if not bodies and operations(extra) <= operations(total) + FEW:  # multiplied out it says no more
        chain = [name, extra]
    shown = tuple(each for place, each in enumerate(chain) if place < 2 or each != chain[1])
    yield Step(letter, shown if shown[1] != ZERO else (name, ZERO), rule)


def _terms(model: Model, letter: str, parts: tuple[Scalar, ...], rule: str) -> list[Expr]:
    """T_1, T_2, ...: the names of the parts of the bodies."""
    if rule != "kinetic":
        return []
    return [Symbol(f"{letter}_{k}") for k in range(1, len(model.system.bodies) + 1)]


def _weight(model: Model, body: MovingBody) -> Expr:
    """-m g . r with the position as given."""
    terms: list[Expr] = []
    for g, r in zip(model.system.gravity, body.position, strict=True):
        if model.scalar(g) and model.scalar(r):
            terms.append(_signless(multiply(body.mass, _plain(g), r), g))
    return add(*terms)


def _plain(g: Expr) -> Expr:
    """The size of a component that is written with a minus sign."""
    return -g if _is_minus(g) else g


def _is_minus(g: Expr) -> bool:
    match g:
        case Number(value):
            return value < 0
        case Product((Number(value), *_)):
            return value < 0
    return False


def _signless(product: Expr, g: Expr) -> Expr:
    """Against a component -g the energy m g y grows."""
    return product if _is_minus(g) else -product
