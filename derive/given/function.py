"""What is given of a function: its formula, and the equations that its variables obey."""

from __future__ import annotations

from collections.abc import Iterator

from derive.algebra.function import Function
from derive.derivation import Phrase
from derive.expression import column
from derive.given.datum import Datum, names
from derive.kinds.function._naming import function_name
from derive.kinds.problem import Problem

IN_QUESTIONS = True


def data(function: Function, problem: Problem) -> Iterator[Datum]:
    """The formula of a name of its own, then the constraints."""
    value = column(function.values) if function.vector else function.values[0]
    said = Phrase("function", {"names": names(function.variables)})
    name = function_name(problem)
    yield Datum(said, equations=((name, value),), ours=frozenset({name.name}))
    if function.constraints:
        equations = tuple((each.left, each.right) for each in function.constraints)
        yield Datum(Phrase("constraints"), equations=equations)
