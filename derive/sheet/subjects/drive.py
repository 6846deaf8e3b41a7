"""drive: a motor that moves a load through a gear, `{rotor: J_m, load: J_l, gear: G}`."""

from __future__ import annotations

from derive.algebra.formulas.quantities import rational
from derive.errors import SheetError
from derive.kinds.fields import Formula, InertiaMoment, OptionsModel, Torque
from derive.mechanics.sensing import Drive
from derive.sheet.source import At, Faults
from derive.sheet.subjects.registry import Known

HARMLESS = frozenset({"gear", "torque", "load_torque"})


class Given(OptionsModel):
    """The inertias of the rotor and of the load, each about its own axis, and the gear between them."""

    rotor: InertiaMoment
    load: InertiaMoment
    gear: Formula | None = None
    torque: Torque | None = None
    load_torque: Torque | None = None


def build(given: Given, at: At, known: Known) -> Drive:
    """The drive. Raises SheetErrors for an inertia, a gear or a motor torque that is not positive."""
    sizes = ("rotor", "load", "gear", "torque")
    values = {name: getattr(given, name) for name in sizes if getattr(given, name) is not None}
    Faults(
        at.fault(f"{name} must be positive", (name,))
        for name, value in values.items()
        if (size := rational(value)) is not None and size <= 0
    ).settle()
    return Drive(given.rotor, given.load, given.gear, given.torque, given.load_torque)


def missing(subject: Drive, need: str, at: At) -> list[SheetError]:
    """The fault where a kind needs the "gear" and none is given."""
    return [at.fault("'gear' is missing", (), "add gear: G", key=True)] if subject.gear is None else []
