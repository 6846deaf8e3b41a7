"""A diagram as a Python script on python-control that connects its blocks and simulates a step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.control.diagram import Block, Diagram
from derive.control.scripts.code import PYTHON
from derive.control.scripts.model import Model
from derive.expression import Expr

POINTS = 5001  # of the simulated curve


def python_control(model: Model) -> str:
    """The script. It prints the numbers of the response; `--plot` shows the curve too."""
    parts = (_head(model), _parameters(model), _transfer(model), _diagram(model), _simulation(model))
    return "\n".join("\n".join(part) + "\n" for part in parts)


def _head(model: Model) -> Iterator[str]:
    loop = "in its control loop" if model.controller else "on its own"
    yield f'"""The {model.subject} {loop}: its block diagram and its response to a unit step.'
    yield ""
    yield "Needs python-control (python3 -m pip install control). With --plot it also shows the curve."
    yield '"""'
    yield ""
    yield "import sys"
    yield ""
    yield "import control"
    yield "import numpy"


def _parameters(model: Model) -> Iterator[str]:
    notes = dict(model.notes)
    yield "# Parameters"
    for name, value in model.parameters:
        note = f"  # {notes[name]}" if name in notes else ""
        yield f"{PYTHON.name(name)} = {PYTHON.write(value)}{note}"
    yield f"stop = {model.stop:g}  # the simulation ends here [s]"


def _transfer(model: Model) -> Iterator[str]:
    yield "# Transfer functions"
    yield 's = control.tf("s")'
    yield f"G = {PYTHON.write(model.plant)}"
    if model.controller is None:
        yield "T = G"
    else:
        yield f"C = {PYTHON.write(model.controller)}"
        yield "T = control.feedback(C * G, 1)"


def _diagram(model: Model) -> Iterator[str]:
    diagram = model.diagram
    yield "# Block diagram: blocks are connected where the name of an output is that of an input"
    yield "blocks = ["
    for block in diagram.blocks:
        if block.shape != "source":
            yield f"    {_block(block, diagram)},"
    yield "]"
    sources = (diagram.input, *diagram.disturbances)
    yield f"loop = control.interconnect(blocks, inputs={_names(sources)}, outputs={_names([diagram.output])})"


def _block(block: Block, diagram: Diagram) -> str:
    inputs = diagram.into(block)
    if block.shape == "sum":
        signed = [("-" if sign < 0 else "") + name for sign, name in zip(block.signs, inputs, strict=True)]
        return f'control.summing_junction({_names(signed)}, "{block.name}")'
    polynomials = f"{_row(block.num)}, {_row(block.den)}"
    ends = f'inputs="{inputs[0]}", outputs="{block.name}"'
    return f"control.tf({polynomials}, {ends})"


def _row(coefficients: Sequence[Expr]) -> str:
    return f"[{', '.join(map(PYTHON.write, coefficients))}]"


def _names(names: Sequence[str]) -> str:
    quoted = (f'"{name}"' for name in names)
    return f"[{', '.join(quoted)}]"


def _simulation(model: Model) -> Iterator[str]:
    output = model.diagram.output
    yield "# Simulation"
    yield f"t = numpy.linspace(0, stop, {POINTS})"
    yield "response = control.step_response(loop, t, input=0, squeeze=True)"
    yield "other = control.step_response(T, t, squeeze=True)"
    yield "y = response.outputs"
    yield 'print("largest difference from T(s):", numpy.max(numpy.abs(y - other.outputs)))'
    yield "if numpy.all(T.poles().real < 0):"
    yield "    for name, number in control.step_info(y, t, yfinal=T.dcgain()).items():"
    yield '        print(f"{name}: {number:.6g}")'
    yield "else:"
    yield f'    print("{output} does not settle; at the end it is", y[-1])'
    yield 'if "--plot" in sys.argv:'
    yield "    import matplotlib.pyplot"
    yield ""
    yield "    matplotlib.pyplot.plot(t, y)"
    yield '    matplotlib.pyplot.xlabel("time [s]")'
    yield f'    matplotlib.pyplot.ylabel("{output}")'
    yield "    matplotlib.pyplot.grid()"
    yield "    matplotlib.pyplot.show()"
