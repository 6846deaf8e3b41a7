"""Sheets of a robotics course turned into worked, verified solution sheets.

From Python: `derive.load("week3.yaml")`, `derive.loads(text)`, `derive.robot(links=[...]).jacobian()`; a
fault is a `DeriveError`. To read the code begin with `build` (sheets in, documents out); docs/design.md names
the nine files of the heart.
"""

from __future__ import annotations

TYPE_CHECKING = False  # as of typing, which the command need not wait for before it looks after Ctrl-C

if TYPE_CHECKING:
    from typing import Any

    from derive.door.answers import Answer
    from derive.door.sheets import Sheet, load, loads
    from derive.door.subjects import Subject
    from derive.errors import SheetErrors as DeriveError

__version__ = "0.1.0"
__all__ = ["Answer", "DeriveError", "Sheet", "Subject", "load", "loads"]
HOMES = {
    "Answer": "derive.door.answers", "Sheet": "derive.door.sheets", "load": "derive.door.sheets",
    "loads": "derive.door.sheets", "Subject": "derive.door.subjects",
}  # fmt: skip


def __getattr__(name: str) -> Any:
    """What stands behind the door, imported when it is asked for; every subject is a function."""
    from importlib import import_module

    if name == "DeriveError":
        return import_module("derive.errors").SheetErrors
    if name in HOMES:
        return getattr(import_module(HOMES[name]), name)
    if not name.startswith("_") and name in import_module("derive.sheet.subjects.registry").subjects():
        return import_module("derive.door.subjects").maker(name)
    raise AttributeError(f"module 'derive' has no attribute {name!r}")


def __dir__() -> list[str]:
    from derive.sheet.subjects.registry import subjects

    return [*__all__, *subjects()]
