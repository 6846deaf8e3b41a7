"""The parameter of a path: coordinates depend on it, and it is not read as a unit, as in 90 deg*s."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from derive.errors import SheetError
from derive.expression import Degrees, Expr, Number, free_symbols, walk
from derive.sheet.faults import did_you_mean
from derive.sheet.source import At
from derive.sheet.subjects.registry import Known


def taken_for_unit(tree: Expr, parameter: str) -> bool:
    """Whether the parameter was read as the unit of a number."""
    numbers = (node for node in walk(tree) if isinstance(node, Number | Degrees))
    return any(parameter in node.unit.split() for node in numbers)


def instead(parameter: str) -> str:
    """What is to be written."""
    return f"write {parameter} first: {parameter}*90 deg, {parameter}*0.5 m; or call the parameter u"


def faults_of(
    parameter: str, trees: Sequence[Expr], key: str, usual: str, at: At, known: Known
) -> Iterator[SheetError]:
    """What is wrong with the parameter of a path whose coordinates stand at `key`; `usual` is one that could
    be written instead."""
    for k, tree in enumerate(trees):
        if taken_for_unit(tree, parameter):
            yield at.fault(f"'{parameter}' was read as a unit here", (key, k), instead(parameter))
    names = {name for tree in trees for name in free_symbols(tree)}
    for name in names & known.where.keys():
        names |= free_symbols(known.where[name])
    if parameter in known.where:
        yield at.fault(f"'{parameter}' has a value under where: and cannot vary", (key,))
    elif parameter not in names:
        hint = did_you_mean(parameter, names) or f"say which letter is: parameter: {usual}"
        yield at.fault(f"the path does not depend on '{parameter}'", (key,), hint)
