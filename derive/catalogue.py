"""What can be asked, said in text: the kinds of every subject, and sheets to start from."""

from __future__ import annotations

import inspect
from types import ModuleType

from derive.errors import SheetError, SheetErrors
from derive.kinds import registry as kinds
from derive.sheet.faults import did_you_mean
from derive.sheet.subjects import registry as subjects

COMMENTS = """\
# Build it with: derive {name}.yaml
# Everything stays exact until it is printed: 0.1 m is 1/10, 30 deg is pi/6. A star marks a joint
# variable (theta1*). 'derive kinds' lists what can be asked.
"""


def overview() -> str:
    """Every kind with its first line, under its subject."""
    lines = []
    for subject in subjects.subjects():
        lines.append(f"{subject}: {_first_line(subjects.load(subject)).partition(': ')[2]}")
        width = max((len(kind) for kind in kinds.kinds_of(subject)), default=0)
        for kind in kinds.kinds_of(subject):
            lines.append(f"  {kind:<{width}}  {_first_line(kinds.load(subject, kind))}")
        lines.append("")
    return "\n".join(lines)


def describe(kind: str) -> str:
    """What one kind answers, its options and results, and a runnable example. Raises SheetErrors."""
    owners, module = _find(kind)
    blocks = [f"{kind} ({', '.join(owners)})", inspect.getdoc(module) or ""]
    blocks.append(_listed("Options", _options(module)))
    blocks.append(_listed("Results", module.RESULTS))
    blocks.append("Example:\n\n" + _indented(module.EXAMPLE.strip()))
    return "\n\n".join(block for block in blocks if block) + "\n"


def starter(name: str, kind: str | None) -> str:
    """A sheet to start from: the example of a kind under a few comments. Raises SheetErrors."""
    chosen = kind or next(iter(kinds.kinds_of("robot")), "")
    _, module = _find(chosen)
    example: str = module.EXAMPLE
    return COMMENTS.format(name=name) + example.strip() + "\n"


def _find(kind: str) -> tuple[list[str], ModuleType]:
    """The subjects a kind can be asked of, and its module."""
    owners = [subject for subject in subjects.subjects() if kind in kinds.kinds_of(subject)]
    if not owners:
        every = {known for subject in subjects.subjects() for known in kinds.kinds_of(subject)}
        raise SheetErrors(
            [SheetError(f"there is no kind '{kind}'", None, did_you_mean(kind, every, "kinds"))]
        )
    return owners, kinds.load(owners[0], kind)


def _options(module: ModuleType) -> dict[str, str]:
    properties = module.Options.model_json_schema(by_alias=True).get("properties", {})
    return {name: _option(schema) for name, schema in properties.items()}


def _option(schema: dict[str, object]) -> str:
    said = str(schema.get("description", "")) or ""
    default = schema.get("default")
    return f"{said} (default {default})".strip() if default not in (None, "", []) else said


def _listed(title: str, entries: dict[str, str]) -> str:
    width = max((len(name) for name in entries), default=0)
    lines = [f"  {name:<{width}}  {meaning}".rstrip() for name, meaning in entries.items()]
    return "\n".join([f"{title}:", *lines]) if lines else f"{title}: none"


def _indented(text: str) -> str:
    return "\n".join(f"    {line}".rstrip() for line in text.splitlines())


def _first_line(module: ModuleType) -> str:
    return (inspect.getdoc(module) or "").partition("\n")[0]
