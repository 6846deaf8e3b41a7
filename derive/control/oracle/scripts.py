"""Scripts of a model as texts: what they simulate, at one s, by the values and the blocks that stand in them.

A script is read as its language reads it, as far as a model goes: assignments in order, blocks, lines. What
is not understood raises ValueError."""

from __future__ import annotations

import ast
import cmath
import operator
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

OPERATORS: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
    ast.Pow: operator.pow,
}  # fmt: skip
FUNCTIONS: dict[str, Callable[..., Any]] = {
    "sqrt": cmath.sqrt, "exp": cmath.exp, "log": cmath.log, "sin": cmath.sin, "cos": cmath.cos,
    "tan": cmath.tan,
    "atan": cmath.atan, "arctan": cmath.atan, "asin": cmath.asin, "arcsin": cmath.asin, "acos": cmath.acos,
    "arccos": cmath.acos, "abs": abs, "minreal": lambda x: x,
    "feedback": lambda through, back: through / (1 + back * through),
}  # fmt: skip
SOURCE, SUM, INTEGRATOR = "Sources/Step", "Math Operations/Sum", "Continuous/Integrator"
GAIN, TRANSFER, RECORD, SCOPE = "Math Operations/Gain", "Continuous/Transfer Fcn", "To Workspace", "Scope"


@dataclass(frozen=True, slots=True)
class Wired:
    """A block: what enters it with which signs, and what it multiplies their sum with at the s."""

    inputs: tuple[tuple[int, str], ...]
    gain: complex
    integrator: bool = False  # is drawn as one


@dataclass(frozen=True)
class Script:
    """What a script simulates: `T` and `G` by its formulas, its blocks, the heights its sources step to."""

    s: complex
    names: Mapping[str, complex]
    blocks: Mapping[str, Wired]
    steps: Mapping[str, float]
    output: str

    def gain(self, source: str) -> complex:
        """The output over a source, by the blocks alone."""
        return self.driven(source)[self.output]

    def driven(self, source: str) -> dict[str, complex]:
        """Every block's output over a source."""
        import numpy

        places = {name: place for place, name in enumerate((*self.blocks, *self.steps))}
        matrix = numpy.eye(len(places), dtype=complex)
        for name, block in self.blocks.items():
            for sign, other in block.inputs:
                matrix[places[name], places[other]] -= sign * block.gain
        drive = numpy.zeros(len(places), dtype=complex)
        drive[places[source]] = 1.0
        found = numpy.linalg.solve(matrix, drive)
        return {name: complex(found[place]) for name, place in places.items()}


@dataclass(slots=True)
class _Reader:
    """Names with values, as far as the script has been read; blocks and what enters them."""

    s: complex
    names: dict[str, Any] = field(default_factory=lambda: {"pi": cmath.pi})
    blocks: dict[str, Wired] = field(default_factory=dict)
    steps: dict[str, float] = field(default_factory=dict)
    output: str = ""

    def value(self, node: ast.expr) -> Any:
        """Of an expression."""
        match node:
            case ast.Constant(value) if isinstance(value, int | float | str):
                return value
            case ast.Name(name):
                return self.names[name]
            case ast.UnaryOp(ast.USub(), inside):
                return -self.value(inside)
            case ast.BinOp(left, sign, right):
                return OPERATORS[type(sign)](self.value(left), self.value(right))
            case ast.List(entries):
                return [self.value(each) for each in entries]
            case ast.Attribute(ast.Name("numpy"), "pi"):
                return cmath.pi
            case ast.Call(ast.Attribute(_, "tf") | ast.Name("tf"), [ast.Constant("s")]):
                return self.s
            case ast.Call(ast.Attribute(_, name) | ast.Name(name), arguments) if name in FUNCTIONS:
                return FUNCTIONS[name](*map(self.value, arguments))
        raise ValueError(ast.unparse(node))

    def text(self, text: str) -> Any:
        """Of an expression of MATLAB."""
        return self.value(ast.parse(text.replace("^", "**").strip(), mode="eval").body)

    def ratio(self, num: Sequence[complex], den: Sequence[complex]) -> complex:
        """Two polynomials at the s, highest power first."""
        above, below = (
            sum(k * self.s**power for power, k in enumerate(reversed(each))) for each in (num, den)
        )
        return complex(above / below)

    def done(self) -> Script:
        """Everything read."""
        names = {name: complex(x) for name, x in self.names.items() if isinstance(x, int | float | complex)}
        return Script(self.s, names, self.blocks, self.steps, self.output)


# -- Python -------------------------------------------------------------------------------------------


def read_python(text: str, s: complex) -> Script:
    """A script on python-control; its input is the first of those connected, all others stay at zero."""
    reader = _Reader(s)
    for statement in ast.parse(text).body:
        match statement:
            case ast.Assign([ast.Name("blocks")], ast.List(entries)):
                for entry in entries:
                    _python_block(reader, entry)
            case ast.Assign([ast.Name("loop")], ast.Call(_, _, keywords)):
                told = {each.arg: reader.value(each.value) for each in keywords}
                (reader.output,) = told["outputs"]
                reader.steps = dict.fromkeys(told["inputs"], 0.0)
            case ast.Assign([ast.Name("response")], ast.Call(_, _, keywords)):
                (place,) = (reader.value(each.value) for each in keywords if each.arg == "input")
                reader.steps[list(reader.steps)[place]] = 1.0
                break
            case ast.Assign([ast.Name(name)], value):
                if name != "t":
                    reader.names[name] = reader.value(value)
    return reader.done()


def _python_block(reader: _Reader, entry: ast.expr) -> None:
    match entry:
        case ast.Call(ast.Attribute(_, "summing_junction"), [inputs, name]):
            pairs = ((-1 if each[0] == "-" else 1, each.removeprefix("-")) for each in reader.value(inputs))
            reader.blocks[reader.value(name)] = Wired(tuple(pairs), 1.0 + 0j)
        case ast.Call(ast.Attribute(_, "tf"), [num, den], keywords):
            told = {each.arg: reader.value(each.value) for each in keywords}
            gain = reader.ratio(reader.value(num), reader.value(den))
            reader.blocks[told["outputs"]] = Wired(((1, told["inputs"]),), gain)
        case _:
            raise ValueError(ast.unparse(entry))


# -- MATLAB -------------------------------------------------------------------------------------------

ASSIGNMENT = re.compile(r"(\w+) = ([^';]+|tf\('s'\));$")
QUOTED = re.compile(r"'([^']*)'")


def read_matlab(text: str, s: complex) -> Script:
    """A script that draws a diagram in Simulink; its output is what is recorded."""
    reader, lines, shapes = _Reader(s), dict[str, dict[int, str]](), dict[str, tuple[str, dict[str, str]]]()
    plain = re.sub(r"\s*\.\.\.\n\s*", " ", re.sub(r"%.*", "", text))
    for line in map(str.strip, plain.split("\n")):
        quoted = QUOTED.findall(line)
        if line.startswith("add_block("):
            shape, name, *told = quoted
            shapes[name[1:]] = shape, dict(zip(told[::2], told[1::2], strict=True))
        elif line.startswith("add_line("):
            (start, _), (end, port) = (each.rsplit("/", 1) for each in quoted[:2])
            lines.setdefault(end, {})[int(port)] = start
        elif (found := ASSIGNMENT.match(line)) and found[1] not in ("out", "response", "model"):
            reader.names[found[1]] = reader.text(found[2].replace("'", '"'))
    for name, (shape, settings) in shapes.items():
        entering = tuple(lines.get(name, {})[port] for port in sorted(lines.get(name, {})))
        _matlab_block(reader, name, shape, settings, entering)
    return reader.done()


def _matlab_block(
    reader: _Reader, name: str, shape: str, told: Mapping[str, str], entering: tuple[str, ...]
) -> None:
    kind = shape.removeprefix("simulink/")
    if kind == SOURCE:
        if float(told["Time"]):
            raise ValueError(f"{name} steps late")
        reader.steps[name] = float(told["After"])
    elif kind == SUM:
        signs = (1 if sign == "+" else -1 for sign in told["Inputs"])
        reader.blocks[name] = Wired(tuple(zip(signs, entering, strict=True)), 1.0 + 0j)
    elif kind == f"Sinks/{RECORD}":
        (reader.output,) = entering
    elif kind != f"Sinks/{SCOPE}":
        (only,) = entering
        if kind == GAIN:
            gain = complex(reader.text(told["Gain"]))
        elif kind == INTEGRATOR:
            gain = 1 / reader.s
        elif kind == TRANSFER:
            gain = reader.ratio(reader.text(told["Numerator"]), reader.text(told["Denominator"]))
        else:
            raise ValueError(shape)
        reader.blocks[name] = Wired(((1, only),), gain, kind == INTEGRATOR)
