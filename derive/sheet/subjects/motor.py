"""motor: a direct-current motor by name, `{control: armature, output: angle}`."""

from __future__ import annotations

from typing import Literal

from derive.control.motor import motor
from derive.control.system import System
from derive.kinds.fields import OptionsModel
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known


class Given(OptionsModel):
    """Which terminals the voltage is applied to, and what is observed."""

    control: Literal["armature", "field"]
    output: Literal["angle", "speed"]


def build(given: Given, at: At, known: Known) -> System:
    """The equations of the motor."""
    return motor(given.control, given.output)
