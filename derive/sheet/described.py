"""Options that are described as a subject is: `path:` beside `find`, written as that of a problem."""

from __future__ import annotations

from typing import Any

from derive.kinds.fields import OptionsModel, described
from derive.sheet.source import At
from derive.sheet.subject import read_subject, subject_place
from derive.sheet.subjects.registry import Known, load


def built(options: type[OptionsModel], at: At, data: dict[str, Any], known: Known) -> dict[str, Any]:
    """The data with the record of each such option in place of what was typed. Raises SheetErrors."""
    records = {name: _record(at, name, known) for name in described(options) if name in data}
    return {**data, **records}


def _record(at: At, name: str, known: Known) -> Any:
    place = subject_place(at, name)
    return load(name).build(read_subject(place, name, known), place, known)
