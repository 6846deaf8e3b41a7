"""A file of another program as the source of a robot."""

from __future__ import annotations

from pathlib import Path

from derive.errors import SheetError, SheetErrors
from derive.sheet.imports.told import Told
from derive.sheet.imports.values import EXACT

ENDINGS = (".urdf", ".xacro", ".csv")
MAX_BYTES = 5_000_000


def imported(path: Path, base: str = "", tip: str = "", within: float = EXACT) -> Told:
    """The robot in a file. `base` and `tip` name links between which the arm is; angles (rad) as near to a simple
    one as `within` are that one. Raises SheetErrors with every fault of the file."""
    if path.suffix == ".csv":
        from derive.sheet.imports.table import table

        return table(text_of(path), path)
    from derive.sheet.imports.arm import arm
    from derive.sheet.imports.elements import elements
    from derive.sheet.imports.urdf import model

    text = text_of(path)
    return arm(model(elements(text, path)), base, tip, within)


def text_of(path: Path) -> str:
    """The text of a file. Raises SheetErrors."""
    try:
        if not path.is_file():
            raise SheetErrors([SheetError(f"{path}: this is no ordinary file")])
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise SheetErrors([SheetError(f"{path}: the file is larger than 5 MB")])
        return content.decode("utf-8-sig").replace("\r\n", "\n").replace("\r", "\n")
    except UnicodeDecodeError as error:
        raise SheetErrors([SheetError(f"{path}: the file is not UTF-8 text", None, "save it as UTF-8")]) from error
    except OSError as error:
        raise SheetErrors([SheetError(f"{path}: {error.strerror or error}")]) from error
