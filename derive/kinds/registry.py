"""Kinds are found by walking the folders; nothing is registered and nothing imported until asked."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType

# Kinds stand in the folder of their subject; `pose` serves every subject that ends in a pose.
FOLDERS = {
    "motion": ("motion", "pose"),
    "frames": ("frames", "pose"),
    "robot": ("robot", "pose"),
    "motor": ("system",),
}
KINDS = Path(__file__).parent
PLUGINS = "derive.kinds"  # entry points named `subject/kind`, each a module like those here


def folders_of(subject: str) -> tuple[str, ...]:
    """The folders of the kinds of a subject."""
    return FOLDERS.get(subject, (subject,))


def kinds_of(subject: str) -> dict[str, str]:
    """Kind -> module name, for one subject, in alphabetical order; those of other packages too."""
    found = {}
    for folder in folders_of(subject):
        for path in (KINDS / folder).glob("[!_]*.py"):
            found[path.stem.replace("_", "-")] = f"derive.kinds.{folder}.{path.stem}"
    return dict(sorted({**_plugins(subject), **found}.items()))


def module_name(subject: str, kind: str) -> str:
    """Where a kind is kept. Raises KeyError."""
    for folder in folders_of(subject):
        stem = kind.replace("-", "_")
        if stem.isidentifier() and stem[0] != "_" and (KINDS / folder / f"{stem}.py").is_file():
            return f"derive.kinds.{folder}.{stem}"
    return _plugins(subject)[kind]


def load(subject: str, kind: str) -> ModuleType:
    """The module of a kind: its `Options`, its `RESULTS` and its `derive`. Raises KeyError."""
    return import_module(module_name(subject, kind))


def _plugins(subject: str) -> dict[str, str]:
    """Entry points named `subject/kind`; looked up only where no kind of ours answers."""
    from importlib.metadata import entry_points  # slow to import, and seldom needed

    pairs = ((plugin.name.partition("/"), plugin.value) for plugin in entry_points(group=PLUGINS))
    return {kind: value for (owner, _, kind), value in pairs if owner == subject}
