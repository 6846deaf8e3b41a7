"""What is wanted of sheets, and what came of one: values that go from one process to another."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from derive.errors import SheetError
from derive.known.files import Digests
from derive.placing import Made

if TYPE_CHECKING:
    from derive.auditing import Found
    from derive.sheet.model import Steps


@dataclass(frozen=True, slots=True)
class Wanted:
    """The options of a build; without an output folder a page is a text."""

    formats: tuple[str, ...]
    problems: bool = False
    space: bool = False
    steps: Steps | None = None
    figures: bool = True
    templates: Path | None = None
    pdf_engine: str = "typst"
    audit: bool = False
    explain: bool = False


@dataclass(frozen=True, slots=True)
class Task:
    """One step of the work on one sheet: to find the faults of its reading, or all of the rest."""

    step: Literal["read", "build"]
    sheet: Path


@dataclass(frozen=True, slots=True)
class Outcome:
    """What came of a sheet.

    `faults` are why it has no pages; an `accident` of ours is one that does not keep others from theirs.
    `read` are the files that it was made of, None where that is not sure, and `written` those that were made.
    `audited` and `explained` are what is told where that was asked, `texts` the pages without a folder.
    """

    warnings: tuple[SheetError, ...] = ()
    faults: tuple[SheetError, ...] = ()
    accident: SheetError | None = None
    made: Made = field(default_factory=Made)
    read: Digests | None = None
    written: Digests = ()
    texts: tuple[str, ...] = ()
    audited: tuple[Found, ...] = ()
    explained: tuple[str, ...] = ()

    @property
    def whole(self) -> bool:
        """Whether all its pages were made."""
        return not (self.faults or self.accident or self.made.faults)
