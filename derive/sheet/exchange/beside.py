"""What is said of an arm that was read: joints beside it, and angles that were rounded."""

from __future__ import annotations

from collections.abc import Iterator

from derive.errors import SheetError, how_many
from derive.sheet.exchange.route import Way
from derive.sheet.exchange.values import degrees_of, written

ROUNDED = 1e-4  # rad: how far the angle meant may be from the one typed


def nearly(along: Way, within: float) -> Iterator[SheetError]:
    """Whether angles were rounded: the first that is nearly a simple one, and no nearer than its digits."""
    for joint in along.joints:
        for angle in joint.origin.rpy:
            near = degrees_of(angle, ROUNDED)
            if near is not None and near % 15 == 0 and degrees_of(angle, within) is None:
                message = f"{written(angle)} is {near} degrees to the digits given, and is taken as it stands"
                hint = "to take such angles for exact ones: derive import FILE --within 1e-4"
                yield (joint.element.one("origin") or joint.element).fault(message, hint, "rpy")
                return


def held(along: Way) -> list[SheetError]:
    """What is said of the joints beside the arm."""
    if not along.beside:
        return []
    first, *more = along.beside
    others = f" and {how_many(len(more), 'other')}" if more else ""
    message = f"joint '{first.name}'{others} {'are' if more else 'is'} not on the way to '{along.tip}'"
    hint = "held at zero, and what hangs there belongs to the link that carries it; else name --tip"
    return [first.element.fault(message, hint)]


def driven(along: Way) -> list[SheetError]:
    """Where a joint beside the arm moves with one of it: what hangs there is welded to nothing."""
    names = {joint.name for joint in along.joints if joint.moves}
    for joint in along.beside:
        if joint.mimic and joint.mimic.joint in names:
            message = f"joint '{joint.name}' moves with '{joint.mimic.joint}', beside the arm"
            return [joint.mimic.element.fault(message, "the bodies of the arm are left out")]
    return []
