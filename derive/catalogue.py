"""What can be asked, said in text: the kinds of every subject, and sheets to start from."""

from __future__ import annotations

import inspect
from types import ModuleType
from typing import Any

from derive.errors import SheetError, SheetErrors
from derive.kinds import registry as kinds
from derive.render.questions import example_of, results_of
from derive.sheet.faults import did_you_mean
from derive.sheet.subjects import registry as subjects

TYPES = {"string": "text", "integer": "a whole number", "number": "a number", "boolean": "true or false"}
COMMENTS = """\
# Build it with: derive {name}.yaml
# Everything stays exact until it is printed: 0.1 m is 1/10, 30 deg is pi/6. A star marks a joint
# variable (theta1*). 'derive kinds' lists what can be asked.
"""


def overview() -> str:
    """Every kind with its first line, under its subject."""
    lines = []
    for subject in subjects.subjects():
        lines.append(f"{subject}: {_meaning(subject)}")
        width = max((len(kind) for kind in kinds.kinds_of(subject)), default=0)
        for kind in kinds.kinds_of(subject):
            lines.append(f"  {kind:<{width}}  {_first_line(kinds.load(subject, kind))}")
        lines.append("")
    lines.append("'derive kinds KIND' shows the options, the results and an example of one of them.")
    return "\n".join(lines) + "\n"


def table() -> str:
    """Subjects and what can be asked of each, as a Markdown table for a page of documentation."""
    rows = ["| subject | what it is | `find` |", "|---|---|---|"]
    for subject in subjects.subjects():
        asked = ", ".join(f"`{kind}`" for kind in kinds.kinds_of(subject))
        rows.append(f"| `{subject}` | {_meaning(subject).removesuffix('.')} | {asked} |")
    return "\n".join(rows) + "\n"


def describe(kind: str) -> str:
    """What one kind answers, its options and results, and a runnable example; of a name that means
    different things of different subjects each of them. Raises SheetErrors."""
    return "\n".join(_described(kind, owners, module) for owners, module in _find(kind))


def _described(kind: str, owners: list[str], module: ModuleType) -> str:
    blocks = [f"{kind} ({', '.join(owners)})", inspect.getdoc(module) or ""]
    blocks.append(_listed("Options", _options(module), _about(module.Options)))
    blocks.append(_listed("Results", results_of(module.__name__)))
    blocks.append("Example:\n\n" + _indented(example_of(module.__name__).strip()))
    return "\n\n".join(block for block in blocks if block) + "\n"


def starter(name: str, kind: str | None) -> str:
    """A sheet to start from: the example of a kind under a few comments. Raises SheetErrors."""
    chosen = kind or next(iter(kinds.kinds_of("robot")), "")
    _, module = _find(chosen)[0]
    return COMMENTS.format(name=name) + example_of(module.__name__).strip() + "\n"


def _find(kind: str) -> list[tuple[list[str], ModuleType]]:
    """The modules of a kind, each with the subjects it can be asked of; that of robots first."""
    found: dict[str, list[str]] = {}
    for subject in sorted(subjects.subjects(), key=lambda name: name != "robot"):
        if kind in (known := kinds.kinds_of(subject)):
            found.setdefault(known[kind], []).append(subject)
    if not found:
        every = {known for subject in subjects.subjects() for known in kinds.kinds_of(subject)}
        raise SheetErrors(
            [SheetError(f"there is no kind '{kind}'", None, did_you_mean(kind, every, "kinds"))]
        )
    return [(sorted(owners), kinds.load(owners[0], kind)) for owners in found.values()]


def _options(module: ModuleType) -> dict[str, str]:
    schema = module.Options.model_json_schema(by_alias=True)
    return {name: _option(part, schema) for name, part in schema.get("properties", {}).items()}


def _option(part: dict[str, Any], schema: dict[str, Any]) -> str:
    """What may stand there, and what does where it is left out."""
    default = part.get("default")
    said = f" (default {default})" if default not in (None, "", []) else ""
    return _form(part, schema) + said


def _form(part: dict[str, Any], schema: dict[str, Any]) -> str:
    if "$ref" in part:
        return _form(schema["$defs"][part["$ref"].rsplit("/", 1)[-1]], schema)
    if "anyOf" in part:
        forms = (_form(form, schema) for form in part["anyOf"] if form.get("type") != "null")
        return " or ".join(dict.fromkeys(forms))
    if "enum" in part:
        return " or ".join(map(str, part["enum"]))
    if "prefixItems" in part:
        return "[" + ", ".join(_form(item, schema) for item in part["prefixItems"]) + "]"
    if "items" in part:
        return f"a list of: {_form(part['items'], schema)}"
    return str(part.get("description", "")).replace("\n", " ") or TYPES.get(str(part.get("type")), "")


def _about(options: type) -> str:
    """What the author of a kind says of its options."""
    return _indented((inspect.getdoc(options) or "").replace("`", ""), 2)


def _listed(title: str, entries: dict[str, str], about: str = "") -> str:
    width = max((len(name) for name in entries), default=0)
    lines = [f"  {name:<{width}}  {meaning}".rstrip() for name, meaning in entries.items()]
    head = [f"{title}:", *([about, ""] if about else ())]
    return "\n".join([*head, *lines]) if lines else f"{title}: none"


def _indented(text: str, by: int = 4) -> str:
    return "\n".join(f"{' ' * by}{line}".rstrip() for line in text.splitlines())


def _meaning(subject: str) -> str:
    return _first_line(subjects.load(subject)).partition(": ")[2]


def _first_line(module: ModuleType) -> str:
    return (inspect.getdoc(module) or "").partition("\n")[0]
