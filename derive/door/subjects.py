"""Subjects without a sheet: `derive.robot(links=[...]).jacobian(rows=["vx", "vy"])`."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from derive.door.answers import Answer
from derive.door.sheets import loads
from derive.kinds.registry import kinds_of
from derive.sheet.faults import did_you_mean

BESIDE = ("where", "symbols", "title", "text", "figure")  # fields of a problem, not of its subject


@dataclass(frozen=True)
class Subject:
    """A subject as a sheet describes it. Every kind that can be asked of it is a method, its options the
    arguments (`from_` for `from`), its value the answer."""

    name: str
    described: Any
    beside: Mapping[str, Any] = field(default_factory=dict)

    def ask(self, kind: str, **options: Any) -> Answer:
        """The answer to a kind by its name, `inverse-kinematics`. Raises DeriveError with every fault of what
        was described and asked."""
        problem = {**self.beside, self.name: self.described, "find": kind, **_plain(options)}
        sheet = json.dumps({"title": kind, "problems": [problem]}, indent=1, default=_written)
        answer = loads(sheet, Path(f"{self.name}.yaml")).problems[0].questions[0].answer
        _ = answer.document
        return answer

    def __getattr__(self, name: str) -> Callable[..., Answer]:
        kind = name.rstrip("_").replace("_", "-")
        if name.startswith("_") or kind not in kinds_of(self.name):
            hint = did_you_mean(kind, kinds_of(self.name)).replace("-", "_")
            raise AttributeError(f"{self.name} has no kind {name!r}; {hint}")

        def asked(**options: Any) -> Answer:
            return self.ask(kind, **options)

        asked.__name__ = name
        return asked

    def __dir__(self) -> list[str]:
        return ["ask", *(kind.replace("-", "_") for kind in kinds_of(self.name))]


def maker(name: str) -> Callable[..., Subject]:
    """The function that describes a subject of this name: by one value, or by its fields; `where`, `symbols`
    and the like stand beside them."""

    def made(described: Any = None, /, **fields: Any) -> Subject:
        beside = {key: fields.pop(key) for key in BESIDE if key in fields}
        if described is not None and fields:
            raise TypeError(f"{name} is described by one value or by fields, not by both")
        return Subject(name, _plain(fields) if described is None else described, beside)

    made.__name__ = made.__qualname__ = name
    made.__doc__ = f"A {name}, described as in a sheet; every kind asked of it is a method."
    return made


def _plain(fields: Mapping[str, Any]) -> dict[str, Any]:
    """Names that Python keeps for itself end in a line."""
    return {name.rstrip("_"): value for name, value in fields.items()}


def _written(value: Any) -> Any:
    """What JSON has no form for: arrays as lists, SymPy expressions and the like as they print."""
    return value.tolist() if hasattr(value, "tolist") else str(value)
