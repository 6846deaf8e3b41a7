"""Results as code: a function for each, with common sub-expressions taken out, by SymPy's own printers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import sympy
from sympy.printing.c import C99CodePrinter
from sympy.printing.codeprinter import CodePrinter
from sympy.printing.julia import JuliaCodePrinter
from sympy.printing.numpy import NumPyPrinter
from sympy.printing.octave import OctaveCodePrinter

Language: TypeAlias = Literal["python", "matlab", "c", "julia"]
Lines: TypeAlias = Sequence[tuple[str, str]]
ODD = re.compile(r"\W")


@dataclass(frozen=True, slots=True)
class Function:
    """Printed for one language: its arguments, the lines before the result, and the entries of that, which
    has so many columns; a scalar has none."""

    name: str
    arguments: Sequence[str]
    lines: Lines
    rows: Sequence[Sequence[str]]
    scalar: bool


def functions(results: Mapping[str, Any], language: Language, name: str | None = None) -> str:
    """A function for each result, or for that of this `name`. Raises ValueError for another language, for a
    name that is none, and where there is no formula."""
    if language not in WRITERS:
        raise ValueError(f"{language!r} is none of {', '.join(WRITERS)}")
    if name is not None and name not in results:
        raise ValueError(f"{name!r} is none of {', '.join(results)}")
    chosen = {name: results[name]} if name is not None else results
    printer, head, write = WRITERS[language]
    found = [write(_printed(each, value, printer())) for each, value in _formulas(chosen)]
    if not found:
        raise ValueError("there is no formula to be computed")
    return head + "\n\n".join(found) + "\n"


def _formulas(results: Mapping[str, Any]) -> Iterator[tuple[str, sympy.Basic]]:
    """Names with what they compute; a solution is a column of its values."""
    for name, value in results.items():
        if isinstance(value, sympy.Basic | sympy.MatrixBase):
            yield name, value
        elif isinstance(value, list):
            solutions = [each for each in value if isinstance(each, Mapping)]
            yield from ((f"{name}_{k}", _solution(each)) for k, each in enumerate(solutions, 1))


def _solution(values: Mapping[str, Any]) -> sympy.Matrix:
    """The unknowns in turn, with those found before put in."""
    found: dict[sympy.Symbol, sympy.Expr] = {}
    for name, value in values.items():
        if isinstance(value, sympy.Basic):
            found[sympy.Symbol(name, real=True)] = value.subs(found)
    return sympy.ImmutableMatrix([[each] for each in found.values()])


def _printed(name: str, value: Any, printer: CodePrinter) -> Function:
    scalar = not isinstance(value, sympy.MatrixBase)
    matrix = sympy.ImmutableMatrix([[value]]) if scalar else value
    free = sorted(matrix.free_symbols, key=lambda symbol: symbol.name)
    fresh = sympy.numbered_symbols("k", exclude=free)
    lines, (whole,) = sympy.cse([matrix], fresh)
    rows = [[printer.doprint(entry) for entry in row] for row in whole.tolist()]
    written = [(printer.doprint(left), printer.doprint(right)) for left, right in lines]
    return Function(ODD.sub("_", name), [*map(printer.doprint, free)], written, rows, scalar)


def _python(function: Function) -> str:
    lines = "".join(f"    {left} = {right}\n" for left, right in function.lines)
    entries = ",\n        ".join(f"[{', '.join(row)}]" for row in function.rows)
    whole = function.rows[0][0] if function.scalar else f"numpy.array([\n        {entries},\n    ])"
    return f"def {function.name}({', '.join(function.arguments)}):\n{lines}    return {whole}\n"


def _matlab(function: Function) -> str:
    lines = "".join(f"    {left} = {right};\n" for left, right in function.lines)
    whole = "[" + "; ".join(", ".join(row) for row in function.rows) + "]"
    head = f"function result = {function.name}({', '.join(function.arguments)})"
    return f"{head}\n{lines}    result = {whole};\nend\n"


def _julia(function: Function) -> str:
    lines = "".join(f"    {left} = {right}\n" for left, right in function.lines)
    rows = "; ".join(" ".join(f"({entry})" for entry in row) for row in function.rows)
    whole = function.rows[0][0] if function.scalar else f"[{rows}]"
    return f"function {function.name}({', '.join(function.arguments)})\n{lines}    return {whole}\nend\n"


def _c(function: Function) -> str:
    lines = "".join(f"    const double {left} = {right};\n" for left, right in function.lines)
    arguments = [f"double {name}" for name in function.arguments]
    if function.scalar:
        head = f"double {function.name}({', '.join(arguments) or 'void'})"
        return f"{head}\n{{\n{lines}    return {function.rows[0][0]};\n}}\n"
    shape = f"[{len(function.rows)}][{len(function.rows[0])}]"
    entries = "".join(
        f"    result[{i}][{j}] = {entry};\n"
        for i, row in enumerate(function.rows)
        for j, entry in enumerate(row)
    )
    head = f"void {function.name}({', '.join([*arguments, f'double result{shape}'])})"
    return f"{head}\n{{\n{lines}{entries}}}\n"


def _numpy() -> CodePrinter:
    return NumPyPrinter({"fully_qualified_modules": True})


WRITERS: Mapping[str, tuple[Callable[[], CodePrinter], str, Callable[[Function], str]]] = {
    "python": (_numpy, "import numpy\n\n\n", _python),
    "matlab": (OctaveCodePrinter, "1;  % a script of functions\n\n", _matlab),
    "c": (C99CodePrinter, "#include <math.h>\n\n", _c),
    "julia": (JuliaCodePrinter, "", _julia),
}
