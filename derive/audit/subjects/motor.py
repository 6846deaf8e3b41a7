"""A motor is a system, whose equations stand in `system.plant` once more."""

from __future__ import annotations

from derive.audit.subjects.system import KINDS as KINDS
