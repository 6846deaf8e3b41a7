"""What a model is held to: its scripts, read as texts, simulate what the equations say."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from derive.control.oracle import poles
from derive.control.oracle.equations import Numeric, is_close, value
from derive.control.oracle.scripts import Script, read_matlab, read_python
from derive.derivation import Claim
from derive.expression import Expr, Symbol
from derive.kinds.checks import route
from derive.kinds.system._model_facts import Facts
from derive.kinds.system._oracle import Held, Point, reals

READERS = {"model.m": read_matlab, "model.py": read_python}
SHORT = 0.1  # of the time constant of any motion of the loop
NEARLY, LONGER = 1e-6, 1.2  # of the time that is simulated


@dataclass(frozen=True, slots=True)
class Files:
    """The scripts, with how long the response takes and its polynomials, in numbers."""

    texts: Mapping[str, str]
    takes: float
    num: Sequence[float]
    den: Sequence[float]


def proofs(held: Held, files: Files, told: Facts) -> Iterator[Claim]:
    """Each script by its formulas and by its blocks; what is said of them."""
    for name, text in files.texts.items():
        if not _is_understood(name, text):
            yield route("script", (False,), file=name)
            return
        of_file = partial(_script, held, name, text, told)
        yield route("script", held.compared(of_file), file=name)
        yield route("simulation", _simulates(name, text, held, files), file=name)
    yield route("as-said", _said(held, files, told))


def _is_understood(name: str, text: str) -> bool:
    """Whether a script is one that simulates the step of one source."""
    try:
        return bool(_stepping(READERS[name](text, 1.0 + 1.0j)))
    except (ValueError, KeyError):
        return False


def _script(held: Held, name: str, text: str, told: Facts, at: Point) -> Iterator[bool]:
    script, point, s = READERS[name](text, at["s"]), reals(at), at["s"]
    solved = Numeric.of(held.system, held.source, point)
    strength = _filtered(held, told, point, s)
    wanted = solved.gain(s) if held.controller is None else solved.closed(s, strength)
    yield is_close(script.names["G"], solved.gain(s))
    yield is_close(script.names["T"], wanted)
    inside = script.driven(_stepping(script))
    yield is_close(inside[script.output], wanted)
    error = 1 - wanted
    put_in = 1.0 if held.controller is None else strength * error
    for signal, right in solved.signals(s, {held.source: put_in}).items():
        yield signal not in script.blocks or is_close(inside[signal], right)
    if told.error is not None:
        difference = told.error[0]
        yield isinstance(difference, Symbol) and is_close(inside[difference.name], error)
    if held.controller is not None:
        yield is_close(script.names["C"], strength)
    disturbance = held.system.disturbance
    if disturbance is not None and disturbance.name in script.steps:
        driven = (
            solved.signals(s, {disturbance: 1.0})
            if held.controller is None
            else solved.disturbed(s, strength)
        )
        yield is_close(script.gain(disturbance.name), driven[held.system.output.name])


def _stepping(script: Script) -> str:
    """The source that steps; none where several do."""
    names = [name for name, height in script.steps.items() if height]
    return names[0] if len(names) == 1 else ""


def _filtered(held: Held, told: Facts, point: Mapping[str, float], s: complex) -> complex:
    """The controller with its derivative behind the filter that is told."""
    if held.controller is None or not told.filter:
        return held.strength(point, s)
    ((_, constant),) = told.filter
    derivative = held.controller.family.index("D")
    part = value(held.controller.gains[derivative], dict(point)) * s
    return held.strength(point, s) - part + part / (value(constant, {}) * s + 1)


def _simulates(name: str, text: str, held: Held, files: Files) -> Iterator[bool]:
    """One source steps, to 1, at once; the others stay at zero; it ends when the response has ended."""
    script = READERS[name](text, 1.0 + 1.0j)
    reference = held.system.input.name if held.controller is None else _stepping(script)
    yield sorted(script.steps.values())[:-1] == [0.0] * (len(script.steps) - 1)
    yield script.steps[reference] == 1.0 and script.output == held.system.output.name
    yield held.controller is None or reference not in held.system.names
    stop = script.names["stop"].real
    yield files.takes * (1 - NEARLY) <= stop <= files.takes * LONGER
    yield stop >= poles.worth_seeing(files.num, files.den)


def _said(held: Held, files: Files, told: Facts) -> Iterator[bool]:
    """The loop, its controller as it is written, the filter that is short, the values; which sources there
    are."""
    system, controller = held.system, held.controller
    yield told.closed == (controller is not None) and told.motor == system.motor
    yield told.family == (controller.family if controller else "")
    yield (told.input, told.output) == (system.input, system.output)
    signals = Numeric.of(system, held.source, {}).unknown
    scripts = [READERS[name](text, 1.0 + 1.0j) for name, text in files.texts.items()]
    for script in scripts:
        stepping = _stepping(script)
        others = {each for each in script.steps if each != stepping}
        yield told.reference is None or told.reference.name == stepping
        yield {each.name for each in told.disturbances} == others
        own = len(script.blocks) - _around(told)
        yield own == 1 if told.one_block else {each.name for each in signals} <= script.blocks.keys()
    yield told.taps == _taps(held, read_matlab(files.texts["model.m"], 1.0 + 1.0j))
    yield (told.error is not None) == (told.reference is not None) == told.closed
    if told.error is not None and told.reference is not None:
        yield told.error[0] in [Symbol(each) for each in scripts[0].blocks]
        yield told.error[1] == told.reference - told.output
    known = {**held.problem.where, **(held.given or {})}
    yield {chain[0]: chain[-1] for chain in told.point} == {
        Symbol(name): tree for name, tree in known.items()
    }
    if controller is not None and told.controller is not None:
        typed = dict(told.gains) | dict(told.filter)
        yield from held.compared(lambda at: [_is_controller(held, told, told.controller, typed, at)])
        yield {*dict(told.gains).values()} <= {*controller.gains}
    if told.filter:
        ((_, constant),) = told.filter
        fastest = max(map(abs, poles.roots_of(files.den)), default=0.0)
        yield 0 < value(constant, {}).real * fastest <= SHORT or not fastest


def _is_controller(held: Held, told: Facts, tree: Expr | None, typed: Mapping[Expr, Expr], at: Point) -> bool:
    """As it is written, with its gains."""
    known = dict(at)
    for name, gain in typed.items():
        if isinstance(name, Symbol):
            known[name.name] = value(gain, dict(at))
    return tree is not None and is_close(value(tree, known), _filtered(held, told, reals(at), at["s"]))


def _taps(held: Held, script: Script) -> bool:
    """Whether a line begins in front of an integrator, at what is no signal of the equations, and leads
    elsewhere."""
    before = {name for block in script.blocks.values() if block.integrator for _, name in block.inputs}
    others = {name for block in script.blocks.values() if not block.integrator for _, name in block.inputs}
    return bool((before & others) - held.system.names)


def _around(told: Facts) -> int:
    """Blocks that are not the system's own: the sum and the terms of the controller."""
    if not told.closed:
        return 0
    return 1 + len(told.family) + (len(told.family) > 1)
