"""The direct-current motor as equations in the Laplace domain.

Dorf and Bishop, Modern Control Systems, section 2.5: an armature-controlled motor has a back
electromotive force, a field-controlled one has none; the load is an inertia J with friction b.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from derive.algebra.formulas.grammar import parse_equation
from derive.control.system import Equation, System
from derive.expression import Symbol

Control: TypeAlias = Literal["armature", "field"]
Output: TypeAlias = Literal["angle", "speed"]

_ELECTRICAL = {
    "armature": ("T_m = K_m*I_a", "V_a = (R_a + L_a*s)*I_a + V_b", "V_b = K_b*{speed}"),
    "field": ("T_m = K_m*I_f", "V_f = (R_f + L_f*s)*I_f"),
}
INSIDE = {  # signals between voltage and load: current, torque, induced voltage, torque at the load
    "armature": tuple(map(Symbol, ("I_a", "T_m", "V_b", "T_L"))),
    "field": tuple(map(Symbol, ("I_f", "T_m", "T_L"))),
}
_LOAD = {
    "angle": "T_L = J*s^2*theta + b*s*theta",
    "speed": "T_L = J*s*omega + b*omega",
}
_SPEED = {"angle": "s*theta", "speed": "omega"}


def motor(control: Control, output: Output) -> System:
    """The equations of a motor from its voltage to its angle theta or its speed omega.

    The disturbance is the torque T_d.
    """
    texts = (*_ELECTRICAL[control], "T_m = T_L + T_d", _LOAD[output])
    equations = tuple(Equation(*parse_equation(text.format(speed=_SPEED[output]))) for text in texts)
    voltage = Symbol("V_a" if control == "armature" else "V_f")
    signal = Symbol("theta" if output == "angle" else "omega")
    return System(equations, voltage, signal, Symbol("T_d"), (control, output))
