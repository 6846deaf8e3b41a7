"""The one subject of a problem, from the sheet itself or from a file beside it."""

from __future__ import annotations

from itertools import islice
from pathlib import Path
from typing import Any

from derive.errors import SheetErrors
from derive.kinds.fields import described
from derive.kinds.registry import kinds_of
from derive.kinds.registry import load as kind
from derive.known.files import lies_below
from derive.sheet.checked import checked
from derive.sheet.exchange.files import ENDINGS, Wish, imported
from derive.sheet.exchange.library import Library
from derive.sheet.faults import MOST, did_you_mean
from derive.sheet.given import QUESTION_KEYS
from derive.sheet.named_files import missing, neighbours
from derive.sheet.other_words import our_word
from derive.sheet.reader import read
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known, load, subjects
from derive.sheet.unfilled import unfilled

A_FILE = ", or the path of a file that ends in .yaml"


def subject_name(at: At, data: dict[str, Any]) -> str:
    """The key under which the subject stands. Raises SheetErrors if there is none, or more than one."""
    found = [name for name in subjects() if name in data]
    if len(found) == 2:  # one of them beside `find:`, as the path of an arm
        first, second = found
        either = _is_option(first, data, second), _is_option(second, data, first)
        found = {(True, False): [second], (False, True): [first]}.get(either, found)
    if len(found) == 1:
        return found[0]
    if found:
        for key in found:  # points: 3 are marks
            if not isinstance(data[key], list | dict) and (ours := our_word(key, QUESTION_KEYS)):
                raise at.error(f"{key}: is a subject, and no number", (key,), f"did you mean {ours}?", True)
        hint = "make it two problems"
        raise at.error(f"a problem has one subject, not {' and '.join(found)}", (found[1],), hint, True)
    hint = "add one of " + ", ".join(subjects())
    for key in islice(data, MOST):
        if (close := did_you_mean(key, subjects())).startswith("did"):
            raise at.error(f"unknown key '{key}'", (key,), close, key=True)
    raise at.error("this problem has no subject", (), hint)


def _is_option(name: str, data: dict[str, Any], subject: str) -> bool:
    """Whether what is asked about the subject has an option of this name."""
    find = data.get("find")
    return (
        isinstance(find, str) and find in kinds_of(subject) and name in described(kind(subject, find).Options)
    )


def subject_place(at: At, name: str) -> At:
    """Where the subject is written: here, or in the file that is named here. Raises SheetErrors."""
    typed = at.value((name,))
    if isinstance(typed, str) and name == "robot" and typed.lower().endswith(ENDINGS):
        inside = Wish(library=Library(folder=at.source.path.parent))
        return At(imported(_beside(at, name, typed), inside).source())
    if not isinstance(typed, str) or not typed.endswith((".yaml", ".yml")):
        return at / name
    source = read(_beside(at, name, typed))
    Faults(unfilled(source)).settle()
    return At(source, (name,)) if isinstance(source.data, dict) and name in source.data else At(source)


def read_subject(at: At, name: str, known: Known) -> Any:
    """The model of the subject written at `at`. Raises SheetErrors."""
    try:
        return checked(load(name).Given, at, at.value(), known.names)
    except SheetErrors as errors:
        if not isinstance(typed := at.value(), str):
            raise
        told = errors.errors[0]
        raise at.error(f"'{typed}' is no {name} and no path of a file", (), f"{told.hint}{A_FILE}") from None


def _beside(at: At, name: str, typed: str) -> Path:
    """The path of a file named in a sheet, which must lie in the folder of the sheet or below it."""
    folder = at.source.path.parent
    path = folder / typed
    if not lies_below(path, folder):
        hint = f"move it to the folder of the sheet: {name}s/{Path(typed).name}"
        raise at.error("the file lies outside the folder of the sheet", (name,), hint)
    if fault := missing(path, typed, "file"):
        near = neighbours(path, folder, (".yaml", ".yml", *ENDINGS))
        hint = did_you_mean(typed, near, "there are") or "its path is relative to the sheet"
        raise at.error(fault, (name,), hint)
    return path
