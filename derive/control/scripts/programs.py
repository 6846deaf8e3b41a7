"""A diagram as a program that simulates a step: what is the same for every diagram stands in a text beside
this module, and what belongs to the diagram is put into it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from string import Template

from derive.control.diagram import Block, Diagram
from derive.control.scripts.code import MATLAB, PYTHON, Language
from derive.expression import Expr

LIBRARY = {
    "source": "simulink/Sources/Step",
    "sum": "simulink/Math Operations/Sum",
    "gain": "simulink/Math Operations/Gain",
    "transfer": "simulink/Continuous/Transfer Fcn",
    "integrator": "simulink/Continuous/Integrator",
}


@dataclass(frozen=True, slots=True)
class Model:
    """A diagram with values for its names: what a program needs to know, whatever its language.

    `parameters` are names and values, those a value needs before it; `plant` is G(s), and `controller`
    C(s) with its filter, None where the input itself steps. `stop` is the time the simulation ends [s].
    """

    diagram: Diagram
    parameters: tuple[tuple[str, Expr], ...]
    plant: Expr
    controller: Expr | None
    stop: float
    subject: str  # "motor" or "system"
    notes: tuple[tuple[str, str], ...] = ()  # parameter -> what it is


def python_control(model: Model) -> str:
    """A script on python-control that connects the blocks. It prints the numbers of the response; `--plot`
    shows the curve too."""
    diagram, write = model.diagram, PYTHON.write
    transfer = [f"G = {write(model.plant)}", "T = G"]
    if model.controller is not None:
        transfer[1:] = [f"C = {write(model.controller)}", "T = control.feedback(C * G, 1)"]
    blocks = (f"    {_connected(block, diagram)}," for block in diagram.blocks if block.shape != "source")
    inputs = _quoted((diagram.input, *diagram.disturbances))
    parameters = _parameters(model, PYTHON, "", "#")
    return _filled(
        "python_control", model, parameters=parameters, transfer=transfer, blocks=blocks, inputs=[inputs]
    )


def simulink(model: Model) -> str:
    """A MATLAB script that draws the diagram in Simulink and compares with T(s). Its last section alone needs
    Simulink; the one before it the Control System Toolbox."""
    diagram, write = model.diagram, MATLAB.write
    transfer = [f"G = {write(model.plant)};", "T = minreal(G);"]
    if model.controller is not None:
        transfer[1:] = [f"C = {write(model.controller)};", "T = minreal(feedback(C*G, 1));"]
    blocks = (
        f"add_block('{LIBRARY[block.shape]}', [model '/{block.name}']{_settings(block, diagram)});"
        for block in diagram.blocks
    )
    lines = (
        f"add_line(model, '{line.source}/1', '{line.target}/{line.port}', 'autorouting', 'on');"
        for line in diagram.lines
    )
    scope, record = _free(diagram, "scope"), _free(diagram, "record")
    parameters = _parameters(model, MATLAB, ";", "%")
    return _filled(
        "simulink", model, parameters=parameters, transfer=transfer, blocks=blocks, lines=lines,
        scope=[scope], record=[record],
    )  # fmt: skip


def _filled(name: str, model: Model, **lines: Iterable[str]) -> str:
    """The text of this name with lines in it."""
    text = Path(__file__).with_name(f"{name}.txt").read_text(encoding="utf-8")
    loop = "in its control loop" if model.controller else "on its own"
    whole = {key: "\n".join(each) for key, each in lines.items()}
    return Template(text).substitute(whole, subject=model.subject, loop=loop, output=model.diagram.output)


def _parameters(model: Model, language: Language, end: str, comment: str) -> list[str]:
    notes = {name: f"  {comment} {note}" for name, note in model.notes}
    values = [
        f"{language.name(name)} = {language.write(value)}{end}{notes.get(name, '')}"
        for name, value in model.parameters
    ]
    return [*values, f"stop = {model.stop:g}{end}  {comment} the simulation ends here [s]"]


def _row(coefficients: Sequence[Expr], language: Language) -> str:
    return f"[{', '.join(map(language.write, coefficients))}]"


# -- blocks -------------------------------------------------------------------------------------------


def _connected(block: Block, diagram: Diagram) -> str:
    """A block of python-control, its ends by their names."""
    inputs = diagram.into(block)
    if block.shape == "sum":
        signed = [("-" if sign < 0 else "") + name for sign, name in zip(block.signs, inputs, strict=True)]
        return f'control.summing_junction({_quoted(signed)}, "{block.name}")'
    polynomials = f"{_row(block.num, PYTHON)}, {_row(block.den, PYTHON)}"
    return f'control.tf({polynomials}, inputs="{inputs[0]}", outputs="{block.name}")'


def _quoted(names: Sequence[str]) -> str:
    quoted = (f'"{name}"' for name in names)
    return f"[{', '.join(quoted)}]"


def _settings(block: Block, diagram: Diagram) -> str:
    """What a block of Simulink is told beside its name."""
    match block.shape:
        case "source":
            height = "1" if block.name == diagram.input else "0"
            return f", 'Time', '0', 'After', '{height}'"
        case "sum":
            return f", 'Inputs', '{''.join('+' if sign > 0 else '-' for sign in block.signs)}'"
        case "gain":
            return f", 'Gain', '{MATLAB.write(block.num[0])}'"
        case "transfer":
            num, den = _row(block.num, MATLAB), _row(block.den, MATLAB)
            return f", ...\n    'Numerator', '{num}', 'Denominator', '{den}'"
        case _:
            return ""


def _free(diagram: Diagram, name: str) -> str:
    taken = {block.name for block in diagram.blocks}
    return name if name not in taken else f"{name}_of_{diagram.output}"
