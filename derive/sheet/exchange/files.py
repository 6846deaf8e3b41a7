"""A file of another program as the source of a robot."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from derive.errors import SheetError, SheetErrors
from derive.known.files import noted
from derive.sheet.exchange.library import Library
from derive.sheet.exchange.values import EXACT
from derive.sheet.source import At

if TYPE_CHECKING:
    from derive.mechanics.robot import Robot
    from derive.sheet.exchange.told import Told

ENDINGS = (".urdf", ".xacro", ".csv")
MAX_BYTES = 5_000_000


@dataclass(frozen=True, slots=True)
class Wish:
    """How a description is to be read: the links between which the arm is; how near to a simple angle (rad)
    one is taken for it; where included files are."""

    base: str = ""
    tip: str = ""
    within: float = EXACT
    library: Library = field(default_factory=Library)


def imported(path: Path, wish: Wish = Wish()) -> Told:
    """The robot in a file. Raises SheetErrors with every fault of the file."""
    if path.suffix.lower() not in ENDINGS:
        raise SheetErrors([SheetError(f"{path}: a robot is read from {', '.join(ENDINGS)}")])
    if path.suffix.lower() == ".csv":
        from derive.sheet.exchange.table import table

        return table(text_of(path), path)
    from derive.sheet.exchange.arm import arm
    from derive.sheet.exchange.elements import elements
    from derive.sheet.exchange.urdf import model

    root = elements(text_of(path), path)
    missing: list[SheetError] = []
    if any(name == "xmlns:xacro" for name in root.attributes):
        from derive.sheet.exchange.xacro import expanded

        root, missing = expanded(root, lambda file: elements(text_of(file), file), wish.library)
    try:
        told = arm(model(root), wish.base, wish.tip, wish.within)
    except SheetErrors as errors:
        raise SheetErrors([*missing, *errors.errors]) from errors
    told.doubts[:0] = missing
    return told


def text_of(path: Path) -> str:
    """The text of a file. Raises SheetErrors."""
    noted(path)
    try:
        if not path.is_file():
            raise SheetErrors([SheetError(f"{path}: this is no ordinary file")])
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise SheetErrors([SheetError(f"{path}: the file is larger than 5 MB")])
        return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        raise SheetErrors(
            [SheetError(f"{path}: the file is not UTF-8 text", None, "save it as UTF-8")]
        ) from error
    except OSError as error:
        raise SheetErrors([SheetError(f"{path}: {error.strerror or error}")]) from error


def as_yaml(path: Path, wish: Wish = Wish()) -> tuple[str, list[SheetError]]:
    """A robot's file as YAML, and what is strange about it. Raises SheetErrors."""
    told = imported(path, wish)
    _, strange = _built(At(told.source()))
    return told.yaml(), strange


def as_urdf(path: Path, values: Mapping[str, float]) -> tuple[str, list[SheetError]]:
    """A robot's file as URDF, and what is strange about it or left out. Raises SheetErrors."""
    from derive.sheet.exchange.to_urdf import urdf
    from derive.sheet.reader import read

    at = At(imported(path).source() if path.suffix.lower() in ENDINGS else read(path))
    if isinstance(data := at.value(), dict) and "robot" in data:
        at = at / "robot"
    elif isinstance(data, dict) and "problems" in data:
        raise at.error("this is a sheet, and no robot", ("problems",), "name the file of a robot", key=True)
    robot, strange = _built(at)
    text, left_out = urdf(robot, at, values)
    return text, [*strange, *left_out]


def _built(at: At) -> tuple[Robot, list[SheetError]]:
    """The robot, and what is strange about it. Raises SheetErrors."""
    from derive.sheet.checked import checked
    from derive.sheet.subjects.registry import Known
    from derive.sheet.subjects.robot import Given, build, warnings

    known = Known()
    robot = build(checked(Given, at, at.value(), known.names), at, known)
    return robot, [*at.source.doubts, *warnings(robot, at, known)]
