"""What is known of the end-effector, as the author gives it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import PlainValidator, WithJsonSchema

from derive.errors import FormulaError, NotDerivable
from derive.kinds.fields import read_name
from derive.kinds.problem import Problem
from derive.mechanics.chain import Chain
from derive.mechanics.inverse.goal import Goal, of_coordinates, of_orientation, of_pose

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


def goal_of(given: tuple[str, ...] | str, chain: Chain, problem: Problem) -> Goal:
    """The known pose. Raises NotDerivable where a name stands for something else already."""
    if given == "pose":
        goal = of_pose()
    elif given == "orientation":
        goal = of_orientation()
    else:
        goal = of_coordinates(chain.T_tool, given, chain.variables)
    refuse_namesakes(goal.names, problem.taken)
    return goal


def refuse_namesakes(names: Iterable[str], taken: Iterable[str]) -> None:
    """Raises NotDerivable where a known coordinate is called as something else is."""
    if shared := set(names) & set(taken):
        raise NotDerivable(
            f"'{min(shared)}' names a known coordinate of the end-effector and something else on this sheet; "
            "choose another name for one of them"
        )
