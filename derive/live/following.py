"""A sheet built at each save and shown: the page when it is right, its faults while it is wrong."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from queue import Empty, SimpleQueue
from tempfile import TemporaryDirectory
from threading import Thread
from time import perf_counter, strftime
from typing import Any, TypeAlias

from derive.build import Audit, Warn, build
from derive.errors import SheetError, SheetErrors
from derive.explaining import explained
from derive.kinds.remembered import Remembered
from derive.live.saves import saves
from derive.live.serving import served
from derive.live.view import Section, Shown, View, said, sections
from derive.messages import apology, report, say, warn
from derive.render.document import Document
from derive.render.own_templates import dressed
from derive.sheet.model import Sheet, Steps
from derive.sheet.reader import MAX_BYTES, read

OFTEN = 0.5  # seconds after which Ctrl-C is looked for, where nothing else happens


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is shown of a sheet: as the options of `build`."""

    problems: bool = False
    space: bool = False
    steps: Steps | None = None
    figures: bool = True
    templates: Path | None = None


Wish: TypeAlias = Callable[[Wanted], Wanted] | BaseException
"""How another page is wanted, or why there will be none."""


def follow(sheet: Path, wanted: Wanted, port: int, opened: Callable[[str], object] = lambda _: None) -> None:
    """Serves the page of a sheet, made again at each save, until Ctrl-C; `opened` is told its address.
    Raises OSError where the port cannot be had or the folder cannot be watched."""
    wishes: SimpleQueue[Wish] = SimpleQueue()
    shown = Shown(View(name=sheet.name))
    known = Remembered()
    saved = saves(sheet, wanted.templates)
    next(saved)  # what is saved while the first page is made is not missed
    Thread(target=_watch, args=(saved, wishes), daemon=True).start()

    def ask(steps: Steps | None) -> None:
        wishes.put(lambda wanted: replace(wanted, steps=steps))

    with served(shown, port, ask) as address:
        say(f"{sheet} is shown at {address} and follows every save; Ctrl-C ends it")
        opened(address)
        while True:
            shown.show(building=True, steps=wanted.steps)
            shown.show(building=False, **made(sheet, wanted, shown.view.pages, known))
            for wish in _wishes(wishes):
                if isinstance(wish, BaseException):
                    raise wish
                wanted = wish(wanted)


def _watch(saved: Iterator[None], wishes: SimpleQueue[Wish]) -> None:
    try:
        for _ in saved:
            wishes.put(lambda wanted: wanted)
    except BaseException as error:  # told where it can be raised
        wishes.put(error)


def _wishes(wishes: SimpleQueue[Wish]) -> Iterator[Wish]:
    """The next one, and those that came with it."""
    while True:
        try:
            yield wishes.get(timeout=OFTEN)
            break
        except Empty:
            continue
    while not wishes.empty():
        yield wishes.get()


def made(path: Path, wanted: Wanted, pages: int, known: Remembered) -> dict[str, Any]:
    """What there is to show of the sheet as it stands now. Problems that are known are not derived again."""
    began = perf_counter()
    text, where = _source(path)
    strange: list[SheetError] = []
    proved: list[str] = []

    def look(sheets: Sequence[Sheet], documents: Sequence[Document]) -> None:
        if not wanted.problems:
            proved.extend(explained(documents))

    def told(error: SheetError) -> None:
        warn(error)
        strange.append(error)

    found: dict[str, Any] = {"faults": ()}
    try:
        with known.used() if wanted.templates is None else nullcontext():  # templates change what is told
            page = _page(path, wanted, told, look)
    except SheetErrors as errors:
        report(errors, "the last good page is shown")
        found["faults"] = tuple(said(error, str(path)) for error in errors.errors)
    except Exception as error:
        sorry = apology(error)
        say(sorry)
        found["faults"] = (said(SheetError(sorry), str(path)),)
    else:
        seconds = perf_counter() - began
        found |= {
            "page": page,
            "pages": pages + 1,
            "made": strftime("%H:%M:%S"),
            "seconds": round(seconds, 2),
        }
        found["proved"] = tuple(proved)
        say(f"{path}: {found['made']}, {seconds:.1f} s")
    warnings = tuple(said(error, str(path)) for error in strange)
    return {**found, "warnings": warnings, "source": text, "sections": where}


def _page(path: Path, wanted: Wanted, told: Warn, look: Audit) -> str:
    """The page, with all that it shows inside. Raises SheetErrors."""
    with TemporaryDirectory() as folder, dressed(wanted.templates):
        files = build(
            [path], ("html",), Path(folder), wanted.problems, warn=told, audit=look, space=wanted.space,
            figures=wanted.figures, steps=wanted.steps,
        )  # fmt: skip
        (page,) = (file for file in files if isinstance(file, Path) and file.suffix == ".html")
        return page.read_text(encoding="utf-8")


def _source(path: Path) -> tuple[tuple[str, ...], tuple[Section, ...]]:
    """The lines of the sheet, and where its questions stand in them as far as it can be read."""
    try:
        source = read(path)
        ends = source.lines[-1:] == ("",)  # behind the last line end
        return source.lines[: len(source.lines) - ends], tuple(sections(source))
    except SheetErrors:
        with suppress(OSError):
            if path.is_file():  # a pipe might never end
                with path.open(encoding="utf-8-sig", errors="replace") as file:
                    return tuple(file.read(MAX_BYTES).splitlines()), ()
        return (), ()
