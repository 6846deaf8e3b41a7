"""What is given of a path."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase, Said, Table
from derive.expression import ONE, PI, Symbol, column, multiply, number
from derive.given.datum import Datum, vector
from derive.given.moves import moves_said
from derive.kinds.path._naming import place_name
from derive.kinds.problem import Problem
from derive.mechanics.paths import Arc, Curve, Line, Path, Turned, Via

LAWS = {"cubic": "cubic", "quintic": "quintic|fifth|degree five", "trapezoidal": "trapez"}
WORDS = {"axis-angle": "one axis", "slerp": "quaternion|slerp", "euler-angles": "angles"}
FULL = multiply(number(2), PI)


def data(path: Path, problem: Problem) -> Iterator[Datum]:
    """A sentence of the shape, of a function its formula; then how it goes along it in time."""
    yield from _shape(path, problem)
    if path.turned is not None:
        yield from _turned(path.turned)
    if path.timing is not None:
        yield Datum(Phrase(path.timing.law), words=("rest", LAWS[path.timing.law]))
        for key in ("time", "v_max", "a_max"):
            if (value := getattr(path.timing, key)) is not None:
                of_s = isinstance(path.shape, Curve) and key != "time"
                said = f"one-{key}-of-s" if of_s else f"one-{key}"
                about: dict[str, Said] = {"value": measured(value)}
                if isinstance(path.shape, Curve) and of_s:
                    about["s"] = Symbol(path.shape.parameter)
                yield Datum(Phrase(said, about))


def _shape(path: Path, problem: Problem) -> Iterator[Datum]:
    match path.shape:
        case Line(start, end):
            yield Datum(Phrase("line", {"start": vector(start), "end": vector(end)}))
        case Curve(parameter, value, between):
            name = place_name(problem)
            yield Datum(
                Phrase("function", {"s": Symbol(parameter)}),
                equations=((name, value),),
                ours=frozenset({name.name}),
            )
            if between is not None:
                low, high = between
                yield Datum(Phrase("range", {"s": Symbol(parameter), "low": low, "high": measured(high)}))
        case Arc() as arc:
            yield from _arc(arc)
        case Via() as via:
            yield from _via(via)


def _turned(turned: Turned) -> Iterator[Datum]:
    """Both orientations, and the way from one to the other."""
    for key, end in (("start", turned.start), ("end", turned.end)):
        if end.angles is not None:
            about: dict[str, Said] = {"angles": column(end.angles), "order": turned.convention}
            yield Datum(Phrase(f"{key}-angles", about), words=(turned.convention,))
        elif end.matrix is not None:
            yield Datum(Phrase(f"{key}-matrix"), equations=((end.matrix,),))
        else:
            yield Datum(Phrase(f"{key}-moves"), items=(*moves_said(end.moves),))
    yield Datum(Phrase(turned.by), words=(WORDS[turned.by],))


def _via(via: Via) -> Iterator[Datum]:
    rows = tuple((time, *place) for time, place in zip(via.times, via.places, strict=True))
    yield Datum(Phrase("via"), table=Table((Symbol("t"), *map(Symbol, "xyz"[: len(rows[0]) - 1])), rows))
    yield Datum(Phrase(via.ends))


def _arc(arc: Arc) -> Iterator[Datum]:
    yield Datum(Phrase("helix" if arc.pitch is not None else "circle", {"center": vector(arc.center)}))
    if arc.radius is not None:
        yield Datum(Phrase("radius", {"r": measured(arc.radius)}))
    if arc.axis is not None:
        axis: Said = Symbol(arc.axis) if isinstance(arc.axis, str) else column(arc.axis)
        yield Datum(Phrase("its-axis" if isinstance(arc.axis, str) else "axis-along", {"axis": axis}))
    yield Datum(Phrase("starts-at" if arc.placed else "starts-towards", {"start": vector(arc.start)}))
    if arc.pitch is not None:
        yield Datum(Phrase("pitch", {"pitch": measured(arc.pitch)}))
    if arc.turns is not None:
        yield Datum(Phrase("one-turn") if arc.turns == ONE else Phrase("turns", {"turns": arc.turns}))
    elif arc.angle != FULL:
        yield Datum(Phrase("turned", {"angle": arc.angle}))
