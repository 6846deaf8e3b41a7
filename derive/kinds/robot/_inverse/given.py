"""What is known of the end-effector, as the author gives it."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import PlainValidator, WithJsonSchema

from derive.errors import FormulaError
from derive.kinds.fields import read_name

WORDS = ("pose", "orientation")
HINT = "write given: pose, or names for the known coordinates: [x, y], [x, y, phi] or [x, y, z]"


def read(typed: Any) -> tuple[str, ...] | str:
    """A word, or two to four names that differ. Raises FormulaError."""
    if isinstance(typed, str) and typed in WORDS:
        return typed
    if not isinstance(typed, list | tuple) or not 2 <= len(typed) <= 4:
        raise FormulaError("what is known of the end-effector is wanted here", hint=HINT)
    names = tuple(map(read_name, typed))
    if len(set(names)) < len(names):
        raise FormulaError("each known coordinate needs a name of its own", hint=HINT)
    return names


Given: TypeAlias = Annotated[
    tuple[str, ...] | Literal["pose", "orientation"],
    PlainValidator(read),
    WithJsonSchema(
        {
            "anyOf": [
                {"enum": list(WORDS)},
                {"type": "array", "items": {"type": "string"}, "minItems": 2, "maxItems": 4},
            ],
            "description": "pose, orientation, or names for the known coordinates",
        }
    ),
]
