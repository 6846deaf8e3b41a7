"""The block diagram of the system, in its loop where there is a controller, as scripts that simulate it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from derive.algebra.normal import normal
from derive.algebra.numbers.floats import scalar_number
from derive.control.oracle.equations import Numeric, is_close, quotient, value
from derive.control.rational import Rational, written
from derive.control.response import step_response
from derive.control.scripts.programs import Model, python_control, simulink
from derive.control.system import System
from derive.derivation import Claim, Derivation, Drawing, Step
from derive.errors import NotDerivable
from derive.expression import ONE, Expr, Symbol, add, factors_of, free_symbols, is_negative, multiply
from derive.figures.block_diagram import Wired
from derive.figures.loops import pictured
from derive.kinds.checks import random_points, route
from derive.kinds.fields import Evaluation, OptionsModel
from derive.kinds.problem import Problem
from derive.kinds.system._model_checks import Files, proofs
from derive.kinds.system._model_facts import Facts as Facts
from derive.kinds.system._modelled import Answer, controller_formula, modelled
from derive.kinds.system._options import ControllerField
from derive.kinds.system._oracle import Held
from derive.kinds.system._plant import point_chains
from derive.kinds.system.closed_loop import plant_or_loop
from derive.kinds.work import Work

SUBJECTS = ("system", "motor")
CLAIMS = ("blocks", "script", "simulation", "as-said")
S = Symbol("s")
POINTS = 3


class Options(OptionsModel):
    """With a controller the loop is closed and the reference steps, without one the input does."""

    controller: ControllerField | None = None
    """The controller; a gain without a value stays a letter."""
    evaluate: Evaluation = None


def derive(system: System, options: Options, problem: Problem) -> Derivation:
    """One block or two an equation, as a person draws them; scripts with the values typed.

    Raises NotDerivable for a system that differentiates, and where a name has no value.
    """
    base, transfer, solved = plant_or_loop(problem, options.controller, options.evaluate)
    numeric = solved.numeric(transfer)
    if not numeric.proper:
        raise NotDerivable("the transfer function is improper: its step response begins with an impulse")
    answer = modelled(solved, options.controller, transfer)
    takes = _takes(numeric)
    model = _model(answer, takes)
    files = {"model.m": simulink(model), "model.py": python_control(model)}
    steps = tuple(_steps(answer))
    work = Work(problem, _definitions(answer), uses=(base,), steps=steps).claim(*_blocks(answer))
    plots = _pictures(answer)
    results, told = (
        {"matlab": files["model.m"], "python": files["model.py"]},
        _facts(answer, options, bool(plots)),
    )
    held = Held(problem, system.input, options.controller, dict(options.evaluate or ()))
    work = work.claim(*proofs(held, Files(files, takes, *numeric.numbers()), told))
    return work.answer("model", results, told, plots=plots, files=files)


def _pictures(answer: Answer) -> tuple[Drawing, ...]:
    """The diagram, where it can be read."""
    try:
        return (pictured(answer.plant.system, answer.diagram, "diagram").drawing,)
    except NotDerivable:
        return ()


# -- the scripts --------------------------------------------------------------------------------------


def _takes(numeric: Rational) -> float:
    """How long the response is worth looking at [s]."""
    reduced = numeric.reduced()
    return step_response(reduced.num, reduced.den).times[-1]


def _model(answer: Answer, takes: float) -> Model:
    solved = answer.plant
    notes = tuple((name.name, "filter of the derivative [s]") for name, _ in answer.filter)
    return Model(
        answer.diagram,
        tuple(_values(answer)),
        solved.solution.ratio.expr(solved.style),
        controller_formula(answer),
        _round_above(takes),
        "motor" if solved.system.motor else "system",
        notes,
    )


def _round_above(size: float) -> float:
    """Two digits."""
    unit = 10.0 ** (math.floor(math.log10(size)) - 1)
    return float(f"{math.ceil(size / unit - 1e-9) * unit:.2g}")


def _values(answer: Answer) -> Iterator[tuple[str, Expr]]:
    """Every name the scripts use, after those its value is made of."""
    known = [(name, tree) for name, tree in answer.table.items() if name != tree]
    table = {name.name: tree for name, tree in known if isinstance(name, Symbol)}
    used = {name for b in answer.diagram.blocks for c in (*b.num, *b.den) for name in free_symbols(c)}
    used |= free_symbols(answer.plant.solution.ratio.expr())
    done: set[str] = set()
    yield from _in_order(table, [name for name in table if name in used], done)


def _in_order(table: Mapping[str, Expr], names: list[str], done: set[str]) -> Iterator[tuple[str, Expr]]:
    for name in names:
        if name not in done and name in table:
            done.add(name)
            yield from _in_order(table, sorted(free_symbols(table[name])), done)
            yield name, table[name]


# -- the page -----------------------------------------------------------------------------------------


def _steps(answer: Answer) -> Iterator[Step]:
    style = answer.plant.style
    for wired in answer.wired:
        each = wired.realised
        branches = [
            multiply(*factors_of(written(branch.num, style)), Symbol(start))
            for branch, start in zip(each.branches, wired.starts, strict=True)
        ]
        below = written(each.den, style)
        inside = add(*sorted(branches, key=is_negative))
        chain = (Symbol(_head(wired)), inside if below == ONE else inside / below)
        if chain[0] != chain[1]:
            yield Step(f"{_head(wired)}_block", chain, "block")
        for after, before in zip(wired.stages, (*wired.stages[1:], _head(wired)), strict=True):
            if after not in (before, _head(wired)):
                yield Step(f"{after}_block", (Symbol(after), Symbol(before) / S), "integrator")


def _head(wired: Wired) -> str:
    """The block in front of the integrators; where there is none, what enters them."""
    return wired.stages[-1] if len(wired.stages) > wired.realised.integrators else wired.starts[0]


def _definitions(answer: Answer) -> dict[Expr, Expr]:
    """Every signal by the input, the derivatives among them."""
    found = dict(answer.plant.solution.values)
    for wired in answer.wired:
        for order, name in enumerate(wired.stages):
            if order:
                derivative = multiply(*[S] * order, found[wired.realised.signal])
                found[Symbol(name)] = derivative
    return found


def _facts(answer: Answer, options: Options, drawn: bool) -> Facts:
    solved, diagram, closed = answer.plant, answer.diagram, answer.controller is not None
    taps = any(branch.tap for wired in answer.wired for branch in wired.realised.branches)
    return Facts(
        closed=closed,
        family=answer.controller.family if answer.controller else "",
        motor=solved.system.motor,
        one_block=not answer.wired,
        taps=taps,
        input=solved.system.input,
        output=solved.system.output,
        reference=Symbol(diagram.input) if closed else None,
        error=(Symbol("e"), Symbol(diagram.input) - solved.system.output) if closed else None,
        disturbances=tuple(map(Symbol, diagram.disturbances)),
        controller=controller_formula(answer) if answer.filter else None,
        filter=answer.filter,
        gains=tuple((name, tree) for name, tree in answer.gains if name != tree),
        point=point_chains(options.evaluate, solved.problem.where),
        drawn=drawn,
        numbers=(),
    )


# -- what it is held to -------------------------------------------------------------------------------


def _blocks(answer: Answer) -> Iterator[Claim]:
    name = "T" if answer.controller else "G"
    yield route("blocks", _composes(answer), name=name)
    if answer.filter:
        yield route("filtered-loop", _composes_filtered(answer))


def _composes(answer: Answer) -> Iterator[bool]:
    """At random parameters and complex s, with an ideal derivative."""
    names = {name for _, tree in answer.gains for name in free_symbols(tree)}
    names |= {name for tree in answer.plant.problem.names.values() for name in free_symbols(tree)}
    names |= answer.plant.system.names - {"pi"}
    for k, point in enumerate(random_points(names | {"s"}, POINTS)):
        yield _agrees(answer, point, complex(point["s"], 1.0 + k))


def _agrees(answer: Answer, point: Mapping[str, float], s: complex) -> bool:
    at: dict[str, complex] = {name: complex(x) for name, x in point.items()}
    at |= {each.name: value(tree, at) for each, tree in answer.gains}
    at |= {each.name: 0j for each, _ in answer.filter}
    num, den = (
        [scalar_number(c, point) if c else 0.0 for c in side]
        for side in (answer.transfer.num, answer.transfer.den)
    )
    return is_close(answer.diagram.gain(s, at), quotient(num, den, s))


def _composes_filtered(answer: Answer) -> Iterator[bool]:
    """At the values of the sheet, the equations solved as typed."""
    solved, controller = answer.plant, controller_formula(answer)
    names = {name: tree for name, tree in answer.table.items() if name != tree}
    point = {each.name: scalar_number(normal(each, names), {}) for each in names if isinstance(each, Symbol)}
    other = Numeric.of(solved.system, solved.system.input, point)
    for s in (0.3 + 1.1j, 1.7 + 0.4j, 0.1 + 2.3j):
        strength = 1.0 if controller is None else value(controller, {**point, "s": s})
        yield is_close(answer.diagram.gain(s, point), other.closed(s, strength))
