"""Linear systems: their equations solved by `linsolve`, their poles by `nroots`, their step by its modes."""

from __future__ import annotations

from derive.audit.subjects.system.loops import closed_loop, transfer_function
from derive.audit.subjects.system.routh import stability
from derive.audit.subjects.system.scripts import model
from derive.audit.subjects.system.states import state_space
from derive.audit.subjects.system.step import step_response

KINDS = {
    "transfer-function": transfer_function,
    "closed-loop": closed_loop,
    "stability": stability,
    "state-space": state_space,
    "step-response": step_response,
    "model": model,
}
