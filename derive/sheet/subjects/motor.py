"""motor: a direct-current motor by name, `{control: armature, output: angle}`."""

from __future__ import annotations

from typing import Literal

from derive.control.motor import motor
from derive.control.system import System
from derive.kinds.fields import OptionsModel
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known


class Given(OptionsModel):
    """A direct-current motor."""

    control: Literal["armature", "field"]
    """Which terminals the voltage is applied to."""
    output: Literal["angle", "speed"]
    """What is observed."""


def build(given: Given, at: At, known: Known) -> System:
    """The equations of the motor."""
    return motor(given.control, given.output)
