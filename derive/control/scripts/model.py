"""What a script that simulates a diagram needs to know, whatever its language."""

from __future__ import annotations

from dataclasses import dataclass

from derive.control.diagram import Diagram
from derive.expression import Expr


@dataclass(frozen=True, slots=True)
class Model:
    """A diagram with values for its names.

    `parameters` are names and values, those a value needs before it; `plant` is G(s), and `controller`
    C(s) with its filter, None where the input itself steps. `stop` is the time the simulation ends [s].
    """

    diagram: Diagram
    parameters: tuple[tuple[str, Expr], ...]
    plant: Expr
    controller: Expr | None
    stop: float
    subject: str  # "motor" or "system"
    notes: tuple[tuple[str, str], ...] = ()  # parameter -> what it is
