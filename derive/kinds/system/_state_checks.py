"""What matrices of a state space are held to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from derive.algebra.matrix import ScalarMatrix
from derive.algebra.normal import normal
from derive.algebra.numbers.floats import matrix_numbers, scalar_number
from derive.algebra.scalar import Scalar
from derive.control.oracle.equations import is_close, quotient
from derive.control.rational import scalar
from derive.control.routh import remainder
from derive.control.signals import signals
from derive.control.system import System
from derive.derivation import Claim
from derive.expression import Symbol
from derive.kinds.checks import law, random_points, route
from derive.kinds.system._states import Answer

POINTS = 3


def claims_about(answer: Answer) -> Iterator[Claim]:
    """The matrices make up the transfer function, and have its poles as eigenvalues."""
    space, n = answer.space, len(answer.state)
    s, x = Scalar.symbol("s"), ScalarMatrix.column(_responses(answer))
    moving = ScalarMatrix.identity(n).scaled(s) - space.A
    yield law("state-in-s", moving @ x == space.B)
    G = answer.transfer.value
    yield law("transfer-function", (space.C @ x)[0, 0] + space.D[0, 0] == G)
    characteristic = characteristic_of(space.A)
    left = remainder(characteristic, answer.transfer.den)
    yield law("poles-are-eigenvalues", (not any(left),))
    points = tuple(random_points(_parameters(answer.plant.system), POINTS))
    yield route("characteristic", (_is_determinant(space.A, characteristic, point) for point in points))


def _parameters(system: System) -> list[str]:
    """The names in the equations that are no signals."""
    return sorted(system.names - {signal.name for signal in signals(system)} - {"s", "pi"})


def _is_determinant(A: ScalarMatrix, characteristic: Sequence[Scalar], point: Mapping[str, float]) -> bool:
    """At a small and at a large s."""
    import numpy

    whole = numpy.array(matrix_numbers(A, point))
    ours = [scalar_number(k, point) if k else 0.0 for k in characteristic]
    size = max(1.0, float(numpy.abs(whole).max(initial=0.0)))
    places = (scale * complex(0.7, 0.6) for scale in (1.0, size))
    return all(
        is_close(quotient(ours, [1.0], s), complex(numpy.linalg.det(s * numpy.eye(len(whole)) - whole)), 1e-7)
        for s in places
    )


def _responses(answer: Answer) -> list[Scalar]:
    """Every state over the input, as functions of s: by the elimination, not by the matrices."""
    s = Scalar.symbol("s")
    if not answer.is_physical:
        below = scalar(answer.transfer.den) / answer.transfer.den[0]
        return [s**k / below for k in range(len(answer.state))]
    values, drive = answer.plant.solution.values, Scalar.symbol(answer.plant.system.input.name)
    return [normal(Symbol(name), values) / drive * s**order for name, order in answer.space.states]


def characteristic_of(A: ScalarMatrix) -> tuple[Scalar, ...]:
    """det(s 1 - A) by Faddeev and Le Verrier, highest power first."""
    n = A.shape[0]
    found, power = [Scalar.of(1)], ScalarMatrix.identity(n)
    for k in range(1, n + 1):
        product = A @ power
        trace = sum((product[i, i] for i in range(n)), Scalar.of(0))
        found.append(-trace / k)
        power = product + ScalarMatrix.identity(n).scaled(found[-1])
    return tuple(found)
