"""A diagram as a MATLAB script that draws it in Simulink, simulates a step and compares with T(s)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.control.diagram import Block, Diagram
from derive.control.scripts.code import MATLAB
from derive.control.scripts.model import Model
from derive.expression import Expr
from derive.names import free

LIBRARY = {
    "source": "simulink/Sources/Step",
    "sum": "simulink/Math Operations/Sum",
    "gain": "simulink/Math Operations/Gain",
    "transfer": "simulink/Continuous/Transfer Fcn",
    "integrator": "simulink/Continuous/Integrator",
}


def simulink(model: Model) -> str:
    """The script. Its last section alone needs Simulink; the one before it the Control System Toolbox."""
    parts = ([_head(model)], _parameters(model), _transfer(model), _diagram(model), _simulation(model))
    return "\n".join("\n".join(part) + "\n" for part in parts)


def _head(model: Model) -> str:
    loop = "in its control loop" if model.controller else "on its own"
    return f"% The {model.subject} {loop}: block diagram in Simulink and response to a unit step."


def _parameters(model: Model) -> Iterator[str]:
    notes = dict(model.notes)
    yield "%% Parameters"
    for name, value in model.parameters:
        note = f"  % {notes[name]}" if name in notes else ""
        yield f"{MATLAB.name(name)} = {MATLAB.write(value)};{note}"
    yield f"stop = {model.stop:g};  % the simulation ends here [s]"


def _transfer(model: Model) -> Iterator[str]:
    yield "%% Transfer functions"
    yield "s = tf('s');"
    yield f"G = {MATLAB.write(model.plant)};"
    if model.controller is None:
        yield "T = minreal(G);"
    else:
        yield f"C = {MATLAB.write(model.controller)};"
        yield "T = minreal(feedback(C*G, 1));"
    yield "[y, t] = step(T, stop);"


def _diagram(model: Model) -> Iterator[str]:
    diagram = model.diagram
    yield "%% Block diagram"
    yield f"model = '{model.subject}_model';"
    yield "if bdIsLoaded(model)"
    yield "    close_system(model, 0);"
    yield "end"
    yield "new_system(model);"
    yield "open_system(model);"
    for block in diagram.blocks:
        yield f"add_block('{LIBRARY[block.shape]}', [model '/{block.name}']{_settings(block, diagram)});"
    yield f"add_block('simulink/Sinks/Scope', [model '/{_free(diagram, 'scope')}']);"
    record = f"[model '/{_free(diagram, 'record')}']"
    yield f"add_block('simulink/Sinks/To Workspace', {record}, 'VariableName', 'response', ..."
    yield "    'SaveFormat', 'Timeseries');"
    for line in diagram.lines:
        yield f"add_line(model, '{line.source}/1', '{line.target}/{line.port}', 'autorouting', 'on');"
    for sink in ("scope", "record"):
        end = _free(diagram, sink)
        yield f"add_line(model, '{diagram.output}/1', '{end}/1', 'autorouting', 'on');"
    yield "Simulink.BlockDiagram.arrangeSystem(model);"


def _settings(block: Block, diagram: Diagram) -> str:
    match block.shape:
        case "source":
            height = "1" if block.name == diagram.input else "0"
            return f", 'Time', '0', 'After', '{height}'"
        case "sum":
            return f", 'Inputs', '{''.join('+' if sign > 0 else '-' for sign in block.signs)}'"
        case "gain":
            return f", 'Gain', '{MATLAB.write(block.num[0])}'"
        case "transfer":
            num, den = _row(block.num), _row(block.den)
            return f", ...\n    'Numerator', '{num}', 'Denominator', '{den}'"
        case _:
            return ""


def _row(coefficients: Sequence[Expr]) -> str:
    return f"[{', '.join(map(MATLAB.write, coefficients))}]"


def _free(diagram: Diagram, name: str) -> str:
    return free([block.name for block in diagram.blocks], name, f"{name}_of_{diagram.output}")


def _simulation(model: Model) -> Iterator[str]:
    yield "%% Simulation"
    yield "out = sim(model, 'StopTime', num2str(stop), 'RelTol', '1e-6', ..."
    yield "    'MaxStep', num2str(stop/1000));"
    yield "response = out.get('response');"
    yield "plot(response.Time, squeeze(response.Data), t, y, '--');"
    yield "grid on;"
    yield "xlabel('time [s]');"
    yield f"ylabel('{model.diagram.output}', 'Interpreter', 'none');"
    yield "legend('block diagram', 'transfer function');"
