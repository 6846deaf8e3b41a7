"""Generated scripts: not run, but read. Their values, their formulas, and their block diagram as equations
between signals, which `linsolve` reduces to one transfer function."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

import sympy

from derive.audit.algebra import solution
from derive.audit.asked import Asked, Holds, Test
from derive.audit.points import ROUNDED, Point
from derive.audit.putting_back import put_back
from derive.audit.subjects.system.loops import GAINS
from derive.audit.subjects.system.plant import Plant, S, sympified
from derive.audit.text import Unreadable, sympy_of_text

Values: TypeAlias = Mapping[str, sympy.Expr]
LINE = re.compile(r"^(\w+) = ([^;#%\n]+?);?\s*(?:[%#].*)?$", re.MULTILINE)
FILTERS = ("T_f", "tau_f", "T_filter")  # of the derivative
TEXT = r"'([^']*)'"
ADDED = re.compile(r"add_block\('simulink/[\w ]+/([\w ]+)', \[model '/(\w+)'\](.*?)\);", re.DOTALL)
JOINED = re.compile(r"add_line\(model, '(\w+)/1', '(\w+)/(\d+)'")
SETTING = re.compile(rf"{TEXT}, {TEXT}")
SUMMED = re.compile(r'control\.summing_junction\(\[(.*?)\], "(\w+)"\)')
DIVIDED = re.compile(r'control\.tf\(\[(.*?)\], \[(.*?)\], inputs="(\w+)", outputs="(\w+)"\)')
LOOP = re.compile(r"inputs=\[(.*?)\], outputs=\[(.*?)\]\)")


@dataclass
class Diagram:
    """Equations between signals that vanish, and which signal is the output."""

    output: str = ""
    equations: list[sympy.Expr] = field(default_factory=list)
    signals: set[str] = field(default_factory=set)

    def signal(self, name: str) -> sympy.Symbol:
        self.signals.add(name)
        return sympy.Symbol(f"_{name}")

    def response(self) -> sympy.Expr:
        """The output, for the inputs that are typed."""
        names = [self.signal(name) for name in sorted(self.signals)]
        found = solution(self.equations, names)
        if not found:
            raise Unreadable("the blocks contradict each other")
        return found[names.index(self.signal(self.output))]


def model(asked: Asked, point: Point) -> Iterator[Test]:
    """Values, G, C and the whole diagram, s being a number."""
    s = sympified(point, S)
    plant = Plant(asked)
    G = plant.transfer(asked.here).subs(S, s)
    for name, read in (("matlab", _simulink), ("python", _python_control)):
        script = str(asked.results[name])
        values, formulas = _typed(script)
        values = {**values, "s": s}
        yield put_back(name, point, _value(formulas["G"], values), G, "its G is another", ROUNDED)
        C = _controller(asked, values, s)
        if C is not None:
            yield put_back(name, point, _value(formulas["C"], values), C, "its C is another", ROUNDED)
        whole = G if C is None else C * G / (1 + C * G)
        blocks = read(script, values).response()
        yield put_back(name, point, blocks, whole, "its blocks make another function", ROUNDED)
        yield Holds(name, float(values["stop"]) > 0, "the simulation does not begin")


def _controller(asked: Asked, values: Values, s: sympy.Expr) -> sympy.Expr | None:
    """C(s), its derivative behind a filter."""
    given = asked.options.controller
    if given is None:
        return None
    lag = 1 / (next((values[name] for name in FILTERS if name in values), 0) * s + 1)
    terms = (
        sympified(asked.here, asked.formula(k)) * GAINS[letter].subs(S, s) * (lag if letter == "D" else 1)
        for letter, k in zip(given.family, given.gains, strict=True)
    )
    return sum(terms)


# -- texts --------------------------------------------------------------------------------------------


def _typed(script: str) -> tuple[dict[str, sympy.Expr], dict[str, str]]:
    """The values of parameters, and the formulas of G and C."""
    head, _, rest = script.partition("Transfer functions")
    values: dict[str, sympy.Expr] = {}
    for name, text in LINE.findall(head):
        values[name] = _value(text, values)
    return values, {name: text for name, text in LINE.findall(rest) if name in ("G", "C")}


def _value(text: str, values: Values) -> sympy.Expr:
    """A formula of a script with its values."""
    return sympy_of_text(text.replace("^", "**").replace("numpy.", "").strip(), values)


def _polynomial(text: str, values: Values) -> sympy.Expr:
    """From its coefficients, the highest power first."""
    found = sympy.Integer(0)
    for part in text.split(","):
        found = found * values["s"] + _value(part, values)
    return found


def _python_control(script: str, values: Values) -> Diagram:
    """Blocks joined where the name of an output is that of an input."""
    inputs, outputs = (re.findall(r"\w+", each) for each in LOOP.findall(script)[-1])
    diagram = Diagram(outputs[0])
    for k, name in enumerate(inputs):
        diagram.equations.append(diagram.signal(name) - int(k == 0))
    for terms, name in SUMMED.findall(script):
        signed = re.findall(r'"(-?)(\w+)"', terms)
        total = sum(diagram.signal(each) * (-1 if sign else 1) for sign, each in signed)
        diagram.equations.append(diagram.signal(name) - total)
    for top, bottom, before, after in DIVIDED.findall(script):
        left = _polynomial(bottom, values) * diagram.signal(after)
        diagram.equations.append(left - _polynomial(top, values) * diagram.signal(before))
    return diagram


def _simulink(script: str, values: Values) -> Diagram:
    """Blocks by their sort, joined by lines from a block to a port of another."""
    ports = {(target, int(port)): source for source, target, port in JOINED.findall(script)}
    diagram = Diagram(next(ports[name, 1] for sort, name, _ in ADDED.findall(script) if sort == "Scope"))
    for sort, name, rest in ADDED.findall(script):
        settings = dict(SETTING.findall(rest))
        before = [diagram.signal(ports[key]) for key in sorted(ports) if key[0] == name]
        if sort in ("Scope", "To Workspace"):
            continue
        after = diagram.signal(name)
        if sort == "Step":
            diagram.equations.append(after - _value(settings["After"], values))
        elif sort == "Sum":
            signs = zip(settings["Inputs"], before, strict=True)
            diagram.equations.append(after - sum(each if sign == "+" else -each for sign, each in signs))
        elif sort == "Gain":
            diagram.equations.append(after - _value(settings["Gain"], values) * before[0])
        elif sort == "Integrator":
            diagram.equations.append(values["s"] * after - before[0])
        elif sort == "Transfer Fcn":
            top, bottom = (settings[part].strip("[]") for part in ("Numerator", "Denominator"))
            left = _polynomial(bottom, values) * after
            diagram.equations.append(left - _polynomial(top, values) * before[0])
        else:
            raise Unreadable(f"{sort} is no block known here")
    return diagram
