"""sensor: an encoder on a motor, or a voltage switched on and off."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, PlainValidator, Tag, ValidationInfo, WithJsonSchema

from derive.algebra.formulas.grammar import parse
from derive.algebra.formulas.quantities import rational
from derive.algebra.formulas.units import PLAIN
from derive.errors import SheetError
from derive.expression import ONE, ZERO, Expr, number
from derive.kinds.fields import TREES, Formula, OptionsModel, Quantity, declared, text_of
from derive.mechanics.sensing import Absolute, Encoder, Incremental, PulseWidth
from derive.sheet.faults import NO_FORM
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

SHARED = frozenset({"lines", "bits", "turn_bits"})
HARMLESS = frozenset({"edges", "gear", "low", "duty", "mean", "frequency"})
MAX_BITS = 64
FORMS = (
    "write {encoder: incremental, lines: 500, edges: 4}, {encoder: absolute, bits: 12} "
    "or {pwm: 12 V, duty: 40%}"
)


def _share(typed: Any, info: ValidationInfo) -> Expr:
    """A share, typed as 0.4 or as 40%."""
    if isinstance(typed, TREES):
        tree: Expr = typed
        return tree
    text = text_of(typed).strip()
    if not text.endswith("%"):
        return parse(text, dimension=PLAIN, names=declared(info))
    percent = parse(text.removesuffix("%"), dimension=PLAIN, names=declared(info))
    value = rational(percent)
    return percent / 100 if value is None else number(value / 100, decimal=True)


Share: TypeAlias = Annotated[
    Expr, PlainValidator(_share), WithJsonSchema({"type": ["string", "number"], "description": "0.4 or 40%"})
]


class GivenIncremental(OptionsModel):
    """An encoder that counts lines."""

    encoder: Literal["incremental"]
    """The sort of encoder."""
    lines: Formula | None = None
    """The lines a turn, left out where they are asked."""
    edges: Formula = ONE
    """How many edges of each line are counted."""
    gear: Formula | None = None
    """How many times as fast as the link the encoder turns."""


class GivenAbsolute(OptionsModel):
    """An encoder that knows its angle."""

    encoder: Literal["absolute"]
    """The sort of encoder."""
    bits: Formula | None = None
    """The bits a turn, left out where they are asked."""
    turn_bits: Formula | None = None
    """The bits that count turns."""
    gear: Formula | None = None
    """How many times as fast as the link the encoder turns."""


class GivenPwm(OptionsModel):
    """A voltage that is switched."""

    pwm: Quantity
    """The voltage while it is on."""
    low: Quantity = ZERO
    """The voltage for the rest of the period."""
    duty: Share | None = None
    """The share of the period for which it is on."""
    mean: Quantity | None = None
    """The mean that is wanted, in place of the share."""
    frequency: Quantity | None = None
    """How many periods there are in a second."""


def _form(value: Any) -> str | None:
    keys = value if isinstance(value, dict) else {}
    if "pwm" in keys:
        return "=pwm"
    return {"incremental": "=incremental", "absolute": "=absolute"}.get(str(keys.get("encoder")))


Given: TypeAlias = Annotated[
    Annotated[GivenIncremental, Tag("=incremental")]
    | Annotated[GivenAbsolute, Tag("=absolute")]
    | Annotated[GivenPwm, Tag("=pwm")],
    Discriminator(_form, custom_error_type=NO_FORM, custom_error_message=FORMS),
]


def build(given: Given, at: At, known: Known) -> Encoder | PulseWidth:
    """The encoder or the voltage. Raises SheetErrors: sizes that no disc has, a duty beyond 0 and 1."""
    Faults(_pwm_faults(given, at) if isinstance(given, GivenPwm) else _disc_faults(given, at)).settle()
    if isinstance(given, GivenPwm):
        return PulseWidth(given.pwm, given.low, given.duty, given.mean, given.frequency)
    if isinstance(given, GivenIncremental):
        return Encoder(Incremental(given.lines or ZERO, given.edges), given.gear)
    return Encoder(Absolute(given.bits or ZERO, given.turn_bits or ZERO), given.gear)


def missing(subject: Encoder | PulseWidth, need: str, at: At) -> list[SheetError]:
    """The fault where a kind needs an "encoder", a "voltage", or of an encoder its "size", its "turn_bits" or
    that it is "absolute", and this has them not."""
    if isinstance(subject, PulseWidth) or need == "voltage":
        right = isinstance(subject, PulseWidth) and need == "voltage"
        what = "this is no switched voltage" if need == "voltage" else "this is no encoder"
        return [] if right else [at.fault(what, (), FORMS)]
    disc = subject.disc
    absolute = isinstance(disc, Absolute)
    if need in ("absolute", "turn_bits") and not absolute:
        return [at.fault("this is no absolute encoder", (), "write {encoder: absolute, bits: 12}")]
    if need == "turn_bits" and isinstance(disc, Absolute) and disc.turn_bits == ZERO:
        return [at.fault("'turn_bits' is missing", (), "add turn_bits: 12, which count the turns", key=True)]
    if need == "size" and ZERO in ((disc.bits,) if isinstance(disc, Absolute) else (disc.lines,)):
        name = "bits" if absolute else "lines"
        return [at.fault(f"'{name}' is missing", (), f"add {name}: {12 if absolute else 500}", key=True)]
    return []


def _disc_faults(given: GivenIncremental | GivenAbsolute, at: At) -> Iterator[SheetError]:
    sizes = {"lines": 1, "edges": 1, "bits": 1, "turn_bits": 1, "gear": 0}
    for name in sizes:
        value = rational(getattr(given, name, None) or ONE)
        if value is None:
            continue
        if value <= 0:
            yield at.fault(f"{name} must be positive", (name,))
        elif sizes[name] and value.denominator != 1:
            yield at.fault(f"{name} must be a whole number", (name,))
        elif name == "edges" and value not in (1, 2, 4):
            yield at.fault(
                "a line has 1, 2 or 4 edges to count", ("edges",), "4 with two tracks a quarter apart"
            )
        elif name in ("bits", "turn_bits") and value > MAX_BITS:
            yield at.fault(f"no encoder has {value} bits", (name,), f"at most {MAX_BITS}")


def _pwm_faults(given: GivenPwm, at: At) -> Iterator[SheetError]:
    if (given.duty is None) == (given.mean is None):
        yield at.fault("give either the duty or the mean that is wanted", (), "add duty: 40% or mean: 5 V")
    share = None if given.duty is None else rational(given.duty)
    if share is not None and not 0 <= share <= 1:
        yield at.fault("a duty is between 0 and 1", ("duty",), "write 0.4 or 40%")
    high, low, mean = (None if v is None else rational(v) for v in (given.pwm, given.low, given.mean))
    if high is not None and low is not None and high <= low:
        yield at.fault("the voltage must be higher when it is on than when it is off", ("pwm",))
    elif high is not None and low is not None and mean is not None and not low <= mean <= high:
        yield at.fault("the mean lies between the two voltages", ("mean",))
    frequency = None if given.frequency is None else rational(given.frequency)
    if frequency is not None and frequency <= 0:
        yield at.fault("frequency must be positive", ("frequency",))
