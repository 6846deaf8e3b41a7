"""What a question gives beside `find`: its options, and the point at which numbers are wanted."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from derive.algebra.formulas.with_units import measured, unit_of
from derive.derivation import Phrase
from derive.expression import ONE, ZERO, Expr, Matrix, Symbol, number
from derive.given import path
from derive.given.datum import Datum, names, valued, vector
from derive.kinds.problem import Problem
from derive.mechanics.paths import Path

if TYPE_CHECKING:
    from derive.control.controllers import Controller
    from derive.kinds.robot._point import PointOn

ORDINALS = {1: "first", 2: "second", 3: "third", 4: "fourth", 5: "fifth", 6: "sixth", 7: "seventh"}
PLACES, AXES = ("pose", "orientation"), ("x", "y", "z")  # of an end-effector
ELEMENTS = frozenset(f"r{i}{j}" for i in range(1, 4) for j in range(1, 4))
AT_A_POSE = ("evaluate-there", "evaluate-place")  # told by its matrix
Said = Callable[[Any, Any], Datum | None]  # of the value of an option, and of all options


def data(options: Any, at: Mapping[str, Expr]) -> Iterator[Datum]:
    """Each option that was given, and the point."""
    for key in type(options).model_fields:
        value = getattr(options, key)
        if isinstance(value, Path):
            yield from (replace(datum, room="path") for datum in path.data(value, Problem("path", value)))
        elif (
            key in options.model_fields_set & SAID.keys()
            and value is not None
            and (datum := SAID[key](value, options))
        ):
            yield datum
    if at and getattr(options, "given", None) in PLACES and not ELEMENTS - at.keys():
        yield _pose(at)
    elif at:
        yield _values("evaluate", tuple(at.items()))


def _values(key: str, values: tuple[tuple[str, Expr], ...]) -> Datum:
    return Datum(Phrase(key, {"values": tuple(valued(name, value) for name, value in values)}))


def _pose(at: Mapping[str, Expr]) -> Datum:
    """The point where a pose or an orientation is known by its elements: that as a matrix, then the rest."""
    whole = not {*AXES} - at.keys()
    turned = ([at[f"r{i}{j}"] for j in range(1, 4)] for i in range(1, 4))
    rows = [(*row, at[axis]) if whole else (*row,) for row, axis in zip(turned, AXES, strict=True)]
    matrix = Matrix((*rows, (ZERO, ZERO, ZERO, ONE)) if whole else tuple(rows))
    unit = next(filter(None, map(unit_of, (at[axis] for axis in AXES if whole))), "")
    place = (
        Phrase("pose-in", {"unit": unit}) if unit else Phrase("pose-here" if whole else "orientation-here")
    )
    told = ELEMENTS | {*AXES} if whole else ELEMENTS
    others = tuple(valued(name, value) for name, value in at.items() if name not in told)
    if others:
        return Datum(Phrase(AT_A_POSE[0], {"values": others, "place": place}), equations=((matrix,),))
    return Datum(Phrase(AT_A_POSE[1], {"place": place}), equations=((matrix,),))


def _point(point: PointOn | tuple[Expr, ...], _: Any) -> Datum:
    if isinstance(point, tuple):
        return Datum(Phrase("point", {"vector": vector(point)}))
    if point.link is None:
        return Datum(Phrase("at-origin", {"frame": number(point.frame or 0)}), words=("frame",))
    return Datum(Phrase("on-link", {"frame": number(point.link), "point": vector(point.at)}))


def _rows(rows: tuple[str, ...], _: Any) -> Datum:
    return Datum(Phrase("rows", {"rows": names(rows)}))


def _controller(controller: Controller, _: Any) -> Datum:
    gains = tuple(
        valued(name, gain) for name, gain in zip(controller.names, controller.gains, strict=True)
        if gain != Symbol(name)
    )  # fmt: skip
    if gains:
        return Datum(Phrase("gains", {"values": gains}))
    about = {"family": controller.family, "gains": names(controller.names)}
    return Datum(Phrase("family", about), words=(controller.family,))


def _known(given: Any, _: Any) -> Datum:
    if isinstance(given, str):
        return Datum(Phrase(f"known-{given}"), words=(given,))
    return Datum(Phrase("known", {"names": names(given)}))


def _convention(convention: str, options: Any) -> Datum | None:
    words = {"ZYX": "ZYX|yaw|three rotations", "standard": "standard|distal", "modified": "modified|Craig"}
    about: dict[str, Any] = {"convention": convention}
    if getattr(options, "angles", None):
        return Datum(
            Phrase("angles", about | {"names": names(options.angles)}),
            words=(words.get(convention, f"{convention}|three rotations"),),
        )
    if convention in ("standard", "modified"):
        return Datum(Phrase(convention), words=(words[convention],))
    return Datum(Phrase("convention", about), words=(words.get(convention, f"{convention}|three rotations"),))


def _components(key: str) -> Said:
    return lambda value, _: Datum(Phrase(key, {"vector": vector(value)}))


def _worded(key: str, words: Mapping[Any, str]) -> Said:
    """An option with a few values, each with words of its own; one that goes without saying has none."""
    return lambda value, _: Datum(Phrase(f"{key}-{value}"), words=(words[value],)) if value in words else None


def _axes(frame: str, options: Any) -> Datum | None:
    """In which axes the answer is wanted; or in which a force is given."""
    if frame == "tool" and hasattr(options, "force"):
        return Datum(Phrase("force-in-tool"), words=("own frame|axes of the hand",))
    return _worded("in", {"tool": "tool|own frame|end-effector", "body": "body"})(frame, options)


def _counted(key: str) -> Said:
    return lambda value, _: Datum(Phrase(key, {"value": measured(value)}))


def _frames(source: int | str | None, options: Any) -> Datum:
    if isinstance(source, str):
        return Datum(Phrase("input", {"name": Symbol(source)}))
    about = {"source": number(source or 0), "target": number(options.target)}
    return Datum(Phrase("frames", about), words=(f"frame {source}|inverse|T_{source}",))


def _iterations(count: int, _: Any) -> Datum:
    return Datum(Phrase("iterations", {"count": count}) if count > 1 else Phrase("one-iteration"))


def _inputs(inputs: Any, _: Any) -> Datum | None:
    """Those that are known; one that stands for itself is not."""
    known = tuple(each for each in inputs if not isinstance(each, str) and each[1] != Symbol(each[0]))
    return _values("inputs", known) if known else None


def _frame(number: int, _: Any) -> Datum:
    return Datum(
        Phrase("frame", {"frame": str(number)}), words=(f"frame {number}|{ORDINALS.get(number, number)}",)
    )


def _gains(gains: tuple[Expr, ...]) -> Datum:
    return Datum(Phrase("each-gain", {"values": tuple(map(measured, gains))}))


SAID: dict[str, Said] = {
    "rows": _rows,
    "point": _point,
    "controller": _controller,
    "given": _known,
    "convention": _convention,
    "vector": _components("vector"),
    "twist": _components("twist"),
    "force": _components("force"),
    "target": lambda value, _: _components("target")(value, _) if isinstance(value, tuple) else None,
    "start": lambda value, _: _values("start", value),
    "end": lambda value, _: _values("end", value),
    "joints": lambda value, _: Datum(Phrase("joints", {"vector": vector(value)})) if value else None,
    "time": _counted("time"),
    "torque_max": lambda value, _: Datum(Phrase("torque-max", {"values": tuple(map(measured, value))})),
    "at": lambda value, _: _values("at", value) if value else None,
    "inputs": _inputs,
    "method": _worded(
        "method", {"newton": "newton", "gradient": "gradient", "rows": "row", "svd": "singular"}
    ),
    "iterations": _iterations,
    "step": _counted("step"),
    "counts": _counted("counts"),
    "period": _counted("period"),
    "source": _frames,
    "to": _frame,
    "kind": _worded("kind", {"analytic": "analytic|euler"}),
    "frame": _axes,
    "notation": _worded("notation", {"khatib": "khatib|B"}),
    "gain": lambda value, _: _counted("gain")(value, _) if not isinstance(value, tuple) else _gains(value),
    "ends": _worded("ends", {"natural": "natural|accelerations?"}),
}
