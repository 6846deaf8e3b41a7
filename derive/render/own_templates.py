"""An instructor's own templates: a folder whose files stand for those of the house with the same path.

They change how pages look and what they say, not what is derived: the JSON is that of the house, every step
and fact is told, and formulas are read back. What is wrong with a template is a fault with its file and line.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from pathlib import Path
from traceback import walk_tb

from jinja2 import TemplateError, TemplateNotFound, TemplateSyntaxError

from derive.errors import Place, SheetError, SheetErrors
from derive.render.failures import PageFailed
from derive.render.sandbox import Folder, Sandbox
from derive.render.skin import DRESSING, environment, templates, with_templates
from derive.render.untold import Untold

OF_THE_HOUSE = "laws.txt"  # what typed formulas are held to
PACKAGE = '"@'  # begins its name
TEMPLATES = (".j2", ".typ", ".css", ".xml", ".txt")


@contextmanager
def dressed(folder: Path | None) -> Iterator[None]:
    """Pages are made with the templates of this folder before those of the house. Raises SheetErrors, with
    file and line, for what is wrong with them."""
    if folder is None:
        yield
        return
    made = with_templates(Sandbox, Folder(folder))
    made.restrict(folder, _files(folder))
    token = DRESSING.set(made)
    try:
        _require_templates(folder, made)
        yield
    except (SheetErrors, PageFailed):
        raise
    except Exception as error:
        if found := fault_of(error, folder):
            raise SheetErrors([found]) from error
        raise
    finally:
        DRESSING.reset(token)


@contextmanager
def undressed() -> Iterator[None]:
    """The words of the house, whatever the pages say."""
    token = DRESSING.set(None)
    try:
        yield
    finally:
        DRESSING.reset(token)


def _files(folder: Path) -> Iterator[str]:
    """The paths of the templates in a folder."""
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        if (
            path.suffix in TEMPLATES
            and path.is_file()
            and not any(part.startswith(".") for part in inside.parts)
        ):
            yield inside.as_posix()


def _require_templates(folder: Path, made: Sandbox) -> None:
    """Raises SheetErrors with every file that stands for none of ours, or cannot be read."""
    ours = sorted(_files(templates()))
    found = []
    for name in sorted(made.own):
        if place := _package(made, name):
            found.append(SheetError("packages of Typst are not loaded", place, "copy what you need of it"))
        if name == OF_THE_HOUSE:
            found.append(SheetError(f"{folder / name}: the laws of the house are no template"))
        elif name.endswith(".j2"):
            try:
                made.get_template(name)
            except Exception as error:  # whatever a compiler stumbles over
                found += filter(None, [fault_of(error, folder)])
        if name not in ours and not _is_partial(name) and not _of_another_package(name):
            close = get_close_matches(name, ours, n=1)
            hint = f"did you mean {close[0]}?" if close else "a file of your own begins with an underscore"
            found.append(
                SheetError(f"{folder / name}: no template of this path is there to stand for", None, hint)
            )
    if found:
        raise SheetErrors(found)


def _package(made: Sandbox, name: str) -> Place | None:
    """Where a template imports a package, which Typst would load from the network."""
    lines = enumerate(made.text(name).splitlines(), 1) if name.startswith("typst/") else ()
    return next((_place(str(made.folder / name), k) for k, line in lines if PACKAGE in line), None)


def _is_partial(name: str) -> bool:
    return Path(name).name.startswith("_")


def _of_another_package(name: str) -> bool:
    """Whether it has the words of a kind that another package brings."""
    return name.startswith("words/") and "." in Path(name).parent.name


def fault_of(error: BaseException, folder: Path) -> SheetError | None:
    """What is wrong with a template, said with its place; None for what no template has to do with."""
    if isinstance(error, TemplateSyntaxError):
        return SheetError(_said(error), _place(error.filename or error.name or "", error.lineno))
    places = [*_frames(error)]
    own = [place for place in places if Path(place.file).is_relative_to(folder)]
    if isinstance(error, Untold):
        return SheetError(str(error), _of_macro(error, folder) or (own[-1] if own else None))
    if own:
        return SheetError(_said(error), own[-1])
    if places and isinstance(error, TemplateError):
        return SheetError(_said(error), places[-1], "a template of yours lacks what this one names")
    return None


def _frames(error: BaseException) -> Iterator[Place]:
    """The lines of templates that were at work when it happened."""
    for frame, line in walk_tb(error.__traceback__):
        template = frame.f_globals.get("__jinja_template__")
        file = template.filename if template else frame.f_code.co_filename
        if file and Path(file).suffix in TEMPLATES:
            yield _place(file, template.get_corresponding_lineno(line) if template else line)


def _of_macro(error: Untold, folder: Path) -> Place | None:
    """Where the macro stands that did not tell what it has to; the top of the template where it has none."""
    path = folder / error.template
    if not error.template or not path.is_file():
        return None
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    found = (k for k, line in enumerate(lines, 1) if error.macro and f"macro {error.macro}(" in line)
    return _place(str(path), next(found, 1))


def _place(file: str, line: int) -> Place:
    path = Path(file)
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines() if path.is_file() else []
    text = lines[line - 1] if 0 < line <= len(lines) else ""
    return Place(file, line, len(text) - len(text.lstrip()) + 1, text)


def _said(error: BaseException) -> str:
    match error:
        case TemplateNotFound():
            return f"there is no template {error.name}"
        case RecursionError():
            return "this template has no end: it calls itself"
        case TemplateError():
            return error.message or str(error)
    return f"{type(error).__name__}: {error}"


def written_at(formulas: Sequence[str]) -> Place | None:
    """Where a template of one's own has one of these formulas as it was typed."""
    made = environment()
    if not isinstance(made, Sandbox):
        return None
    for name in sorted(made.own):
        for number, line in enumerate(made.text(name).splitlines(), 1):
            if found := next((each for each in formulas if each in line), None):
                return Place(str(made.folder / name), number, line.index(found) + 1, line)
    return None
