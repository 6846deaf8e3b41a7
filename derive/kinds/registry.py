"""Kinds are found by walking the folders; nothing is registered and nothing imported until asked.

A kind answers for the subject that its folder is named after, or for those that it states in a line of
its own, `SUBJECTS = ("motor", "system")`. That line is read from the text of the module.
"""

from __future__ import annotations

import re
from ast import literal_eval
from functools import cache
from importlib import import_module
from pathlib import Path
from types import ModuleType

KINDS = Path(__file__).parent
PLUGINS = "derive.kinds"  # entry points named `subject/kind`, each a module like those here
STATED = re.compile(r"^SUBJECTS = (\(.*?\))", re.MULTILINE | re.DOTALL)


def kinds_of(subject: str) -> dict[str, str]:
    """Kind -> module name, for one subject, in alphabetical order; those of other packages too."""
    found = {kind: module for (owner, kind), module in _ours("[!_]*").items() if owner == subject}
    return dict(sorted({**_plugins(subject), **found}.items()))


def module_name(subject: str, kind: str) -> str:
    """Where a kind is kept. Raises KeyError."""
    stem = kind.replace("-", "_")
    found = _ours(stem) if stem.isidentifier() and stem[0] != "_" else {}
    return found.get((subject, stem.replace("_", "-"))) or _plugins(subject)[kind]


def words_folder(subject: str, kind: str) -> str:
    """Where the words of a kind are. Raises KeyError."""
    return folder_of(module_name(subject, kind))


def folder_of(module: str) -> str:
    """The folder of the words of a module of ours, the package of another's."""
    return module.rpartition(".")[0].removeprefix("derive.kinds.")


def load(subject: str, kind: str) -> ModuleType:
    """The module of a kind: its `Options` and its `derive`. Raises KeyError."""
    return import_module(module_name(subject, kind))


def serves(path: Path) -> tuple[str, ...]:
    """The subjects for which the kind in this file answers."""
    stated = STATED.search(path.read_text(encoding="utf-8"))
    return tuple(literal_eval(stated[1])) if stated else (path.parent.name,)


@cache
def _ours(stem: str) -> dict[tuple[str, str], str]:
    """(subject, kind) -> module name, of the files with such a name."""
    return {
        (subject, path.stem.replace("_", "-")): f"derive.kinds.{path.parent.name}.{path.stem}"
        for path in KINDS.glob(f"[!_]*/{stem}.py")
        for subject in serves(path)
    }


def _plugins(subject: str) -> dict[str, str]:
    """Entry points named `subject/kind`; looked up only where no kind of ours answers."""
    from importlib.metadata import entry_points  # slow to import, and seldom needed

    pairs = ((plugin.name.partition("/"), plugin.value) for plugin in entry_points(group=PLUGINS))
    return {kind: value for (owner, _, kind), value in pairs if owner == subject}
