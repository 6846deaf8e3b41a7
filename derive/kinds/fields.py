"""The types of fields an author fills in: formulas with their units, names, points and vectors.

Each takes text as typed (or an `Expr`, where a program asks) and gives a tree in SI units. The
names declared under `symbols:` come with the validation context, as `{"names": frozenset}`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Annotated, Any, TypeAlias, get_args

from pydantic import (
    BaseModel,
    ConfigDict,
    GetCoreSchemaHandler,
    PlainValidator,
    ValidationInfo,
    WithJsonSchema,
)
from pydantic_core import CoreSchema, core_schema

from derive.algebra.formulas.functions import ARGUMENTS
from derive.algebra.formulas.grammar import parse, parse_equation, parse_starred
from derive.algebra.formulas.likely_mistakes import Doubt, doubtful_angle, words_like_units
from derive.algebra.formulas.read_again import is_as_typed
from derive.algebra.formulas.tokens import tokens
from derive.algebra.formulas.units import (
    ACCELERATION,
    ANGLE,
    ANGLE_UNITS,
    ANGULAR_SPEED,
    ANY,
    FORCE,
    FREQUENCY,
    INERTIA,
    LENGTH,
    MASS,
    SPEED,
    TIME,
    TORQUE,
    UNITS,
    Wanted,
    spoken,
)
from derive.algebra.numbers.floats import number
from derive.control.system import Equation
from derive.errors import FormulaError
from derive.expression import Expr, free_symbols

TREES = get_args(Expr)
MANY_TURNS = 1e6  # rad, of which a sine keeps the nine digits that are compared


class OptionsModel(BaseModel):
    """What stands beside `find`. Fields that are Python words take `Field(alias="from")`."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", populate_by_name=True, arbitrary_types_allowed=True
    )


@dataclass(frozen=True, slots=True)
class Described:
    """The annotation of an option that an author describes as the subject of a problem, whose name is that of
    the option: what stands there is read as such, and this sees the record that was made of it."""

    record: type[Any]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.is_instance_schema(self.record)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: Any) -> dict[str, Any]:
        return {"type": "object"}


def described(options: type[OptionsModel]) -> tuple[str, ...]:
    """The names of such options, which are those of the subjects."""
    fields = options.model_fields.items()
    return tuple(
        name for name, field in fields if any(isinstance(each, Described) for each in field.metadata)
    )


class NoOptions(OptionsModel):
    """None."""


@dataclass(frozen=True, slots=True)
class Starred:
    """A formula and the joint variable marked in it by a star, if one is."""

    expr: Expr
    variable: str | None = None


@dataclass(frozen=True, slots=True)
class _Reader:
    """How a field of one dimension reads its text; the annotation that makes it a pydantic type."""

    dimension: Wanted

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        return core_schema.with_info_plain_validator_function(self.read)

    def __get_pydantic_json_schema__(self, schema: CoreSchema, handler: Any) -> dict[str, Any]:
        what = spoken(self.dimension) if isinstance(self.dimension, tuple) else "a formula"
        return {"type": ["string", "number"], "description": what}

    def read(self, typed: Any, info: ValidationInfo) -> Any:
        if isinstance(typed, TREES):
            return typed
        return self._checked(
            typed, parse(text_of(typed), dimension=self.dimension, names=declared(info)), info
        )

    def _checked(self, typed: Any, tree: Expr, info: ValidationInfo) -> Expr:
        """The tree; what is strange about it is said."""
        units = ANGLE_UNITS if self.dimension is None else UNITS.keys() - declared(info)
        if not is_as_typed(text_of(typed), tree, units):
            raise FormulaError("this was read as another number", hint="please report this with the sheet")
        if self.dimension is not None:
            for word in words_like_units(text_of(typed)):
                doubt(word, info)
        if self.dimension == ANGLE and not free_symbols(tree) and abs(number(tree, {})) > MANY_TURNS:
            raise FormulaError(
                "this angle is too large: its sine has too few digits in floating point",
                hint="leave whole turns out",
            )
        if self.dimension == ANGLE and (strange := doubtful_angle(text_of(typed), tree)):
            doubt(strange, info)
        return tree


class _StarredReader(_Reader):
    """The same, with a star allowed."""

    def read(self, typed: Any, info: ValidationInfo) -> Any:
        if isinstance(typed, Starred):
            return typed
        tree, variable = parse_starred(text_of(typed), dimension=self.dimension, names=declared(info))
        return Starred(self._checked(typed, tree, info), variable)


def doubt(strange: Doubt, info: ValidationInfo) -> None:
    """Says what is strange about a value. Where warnings are gathered it is counted at first; once their
    places are wanted it is raised, as a FormulaError (see `derive.sheet.checked`)."""
    context = info.context or {}
    if strange.word in declared(info) or not context.get("lonely", bool)(strange.word):
        return
    if context.get("telling"):
        raise FormulaError(strange.message, strange.offset, strange.hint)
    context.setdefault("doubts", []).append(strange.message)


def declared(info: ValidationInfo) -> frozenset[str]:
    """The names declared under `symbols:`."""
    return frozenset((info.context or {}).get("names", ()))


def text_of(typed: Any) -> str:
    """The text of a scalar. Raises FormulaError for anything else."""
    if isinstance(typed, str):
        return typed
    if isinstance(typed, int | Fraction) and not isinstance(typed, bool):
        return f"({typed})" if isinstance(typed, Fraction) else str(typed)
    if isinstance(typed, float):
        return repr(typed)
    if typed is None:
        raise FormulaError("a formula is missing")
    raise FormulaError("a formula is wanted here", hint="write one formula, not a list or a mapping")


def read_name(typed: Any) -> str:
    """One name, normalised (a Greek letter is spelled out). Raises FormulaError."""
    found = tokens(text_of(typed))
    if len(found) != 2 or found[0].kind != "name":
        raise FormulaError("a name is wanted here", hint="use letters, digits and _, as theta1 or L_c")
    if found[0].text in ARGUMENTS or found[0].text == "pi":
        raise FormulaError(f"'{found[0].text}' has a meaning of its own", hint="choose another name")
    return found[0].text


def _read_equation(typed: Any, info: ValidationInfo) -> Equation:
    return (
        typed
        if isinstance(typed, Equation)
        else Equation(*parse_equation(text_of(typed), names=declared(info)))
    )


Formula: TypeAlias = Annotated[Expr, _Reader(None)]  # no units but angles: an entry of a rotation
Quantity: TypeAlias = Annotated[Expr, _Reader(ANY)]  # any unit
Length: TypeAlias = Annotated[Expr, _Reader(LENGTH)]
Angle: TypeAlias = Annotated[Expr, _Reader(ANGLE)]
Mass: TypeAlias = Annotated[Expr, _Reader(MASS)]
InertiaMoment: TypeAlias = Annotated[Expr, _Reader(INERTIA)]
Time: TypeAlias = Annotated[Expr, _Reader(TIME)]
Speed: TypeAlias = Annotated[Expr, _Reader(SPEED)]
AngularSpeed: TypeAlias = Annotated[Expr, _Reader(ANGULAR_SPEED)]
Acceleration: TypeAlias = Annotated[Expr, _Reader(ACCELERATION)]
Frequency: TypeAlias = Annotated[Expr, _Reader(FREQUENCY)]
Force: TypeAlias = Annotated[Expr, _Reader(FORCE)]
Torque: TypeAlias = Annotated[Expr, _Reader(TORQUE)]
StarredLength: TypeAlias = Annotated[Starred, _StarredReader(LENGTH)]
StarredAngle: TypeAlias = Annotated[Starred, _StarredReader(ANGLE)]
StarredQuantity: TypeAlias = Annotated[Starred, _StarredReader(ANY)]
Name: TypeAlias = Annotated[
    str, PlainValidator(read_name), WithJsonSchema({"type": "string", "description": "a name, as theta1"})
]
EquationField: TypeAlias = Annotated[
    Equation,
    PlainValidator(_read_equation),
    WithJsonSchema({"type": "string", "description": "left = right"}),
]
Point: TypeAlias = tuple[Length, Length, Length]
Place: TypeAlias = tuple[tuple[str, Expr], ...]  # names and their values, in the order typed


def read_point(typed: Any, info: ValidationInfo) -> Place | None:
    """`true` is the empty point; a mapping gives each name its value. Raises FormulaError."""
    if typed is None or isinstance(typed, tuple):
        return typed
    if typed is True or typed == "true":
        return ()
    if not isinstance(typed, Mapping):
        raise FormulaError("names and their values are wanted here", hint="write {J: 2, b: 0.5}, or true")
    return tuple((read_name(name), formula(value, info)) for name, value in typed.items())


def formula(typed: Any, info: ValidationInfo) -> Expr:
    """The tree of what is typed, of any dimension. Raises FormulaError."""
    return typed if isinstance(typed, TREES) else parse(text_of(typed), dimension=ANY, names=declared(info))


# None where no numbers are asked for; hashable, so that it can stand in the options of a kind.
Evaluation: TypeAlias = Annotated[
    Place | None,
    PlainValidator(read_point),
    WithJsonSchema(
        {"type": ["object", "boolean", "string"], "description": "names and their values, or true"}
    ),
]
