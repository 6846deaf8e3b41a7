"""Kinds are found by walking the folders; nothing is registered and nothing imported until asked."""

from __future__ import annotations

from importlib import import_module
from importlib.metadata import entry_points
from pathlib import Path
from types import ModuleType

# The folders that hold the kinds of each subject. `pose` serves every subject that ends in a pose.
FOLDERS = {
    "motion": ("motion", "pose"),
    "frames": ("frames", "pose"),
    "robot": ("robot", "pose"),
    "system": ("system",),
    "motor": ("system",),
}
PLUGINS = "derive.kinds"  # entry points named `subject/kind`, each a module like those here


def kinds_of(subject: str) -> dict[str, str]:
    """Kind -> module name, for one subject, in alphabetical order."""
    found = {}
    for folder in FOLDERS[subject]:
        for path in (Path(__file__).parent / folder).glob("[!_]*.py"):
            found[path.stem.replace("_", "-")] = f"derive.kinds.{folder}.{path.stem}"
    for plugin in entry_points(group=PLUGINS):
        owner, _, kind = plugin.name.partition("/")
        if owner == subject:
            found[kind] = plugin.value
    return dict(sorted(found.items()))


def load(subject: str, kind: str) -> ModuleType:
    """The module of a kind: its `Options`, its `RESULTS` and its `derive`. Raises KeyError."""
    return import_module(kinds_of(subject)[kind])
