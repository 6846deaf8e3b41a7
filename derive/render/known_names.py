"""What names stand for by the way they are written, of those on a sheet: T_1^0, r_12, omega_x, c_121."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from derive.errors import NotAsWritten
from derive.expression import Expr, Symbol, walk
from derive.render.latex import Printer
from derive.render.layout import Chain, Link, one_line
from derive.render.notation import Notation
from derive.render.printed import Printed

Names = Mapping[str, Notation]  # each with that in which it is printed first
Named = tuple[str, dict[str, str], dict[str, str]]  # a sort, names as they are printed, numbers

ENTRY = re.compile(r"(?P<letter>[a-z])_(?P<row>\d)(?P<column>\d)")
POSE = re.compile(r"T_(?P<frame>\d+)\^(?P<base>\d+)")
FEW = 8  # Christoffel symbols that are told one by one
CHRISTOFFEL = re.compile(r"c_\d{3}")
GRAVITY, LOAD = "g_0", re.compile(r"g_(?P<joint>[1-9])")


def named(formulas: Iterable[Printed], printed: list[Printed]) -> Iterator[dict[str, str]]:
    """What is said of names, one of a sort: the `sort`, the names, each by its letter, and their numbers."""
    names: dict[str, Notation] = {}
    for formula in formulas:
        for node in nodes(formula):
            if isinstance(node, Symbol):
                names.setdefault(node.name, formula.notation)
    for sort, meant, numbers in (*_poses(names), *_entries(names), *_components(names), *_of_motion(names)):
        indices = {number for key, number in numbers.items() if key != "count"}
        if not all(any(number in name for name in meant.values()) for number in indices):
            raise NotAsWritten(f"{meant} have other indices than {numbers}")
        if not all(name[0].isalpha() for name in meant.values()):
            raise NotAsWritten(f"{meant} are no names")
        parts = {key: alone(Symbol(name), names[name], printed) for key, name in meant.items()}
        yield {"sort": sort, **parts, **numbers}


def _poses(names: Names) -> Iterator[Named]:
    """T_1^0, with R_1^0 and o_1^0 where they stand too."""
    found = [match for name in names if (match := POSE.fullmatch(name))]
    parts = [
        {"T": match[0], **{part: other for part in "Ro" if (other := part + match[0][1:]) in names}}
        for match in found
    ]
    if found:
        most = max(range(len(found)), key=lambda k: len(parts[k]))
        yield "pose", parts[most], found[most].groupdict()


def _entries(names: Names) -> Iterator[Named]:
    """The first entry of each matrix that goes by a small letter: r_12 of R."""
    first: dict[str, re.Match[str]] = {}
    for name in names:
        if (found := ENTRY.fullmatch(name)) and found["letter"].upper() in names:
            first.setdefault(found["letter"].upper(), found)
    for matrix, found in first.items():
        numbers = {"row": found["row"], "column": found["column"]}
        yield "entry", {"name": found[0], "matrix": matrix}, numbers


def _components(names: Names) -> Iterator[Named]:
    """The first component of a vector of three that goes by its letter: omega_x of omega."""
    for name in names:
        vector = name.removesuffix("_x")
        if vector != name and {vector, f"{vector}_y", f"{vector}_z"} <= {*names}:
            yield "component", {"name": name, "vector": vector}, {}
            return


def _of_motion(names: Names) -> Iterator[Named]:
    """The Christoffel symbols, which look like cosines: each where they are few; the vector of gravity beside
    the loads it makes."""
    if found := [*filter(CHRISTOFFEL.fullmatch, names)]:
        few = found if len(found) <= FEW else found[:1]
        yield "christoffel", {f"name_{k}": name for k, name in enumerate(few)}, {"count": str(len(found))}
    loads = (load for name in names if (load := LOAD.fullmatch(name)))
    if GRAVITY in names and (load := next(loads, None)):
        yield "gravity", {"vector": GRAVITY, "load": load[0]}, load.groupdict()


def alone(tree: Expr, notation: Notation, printed: list[Printed]) -> str:
    """A tree in a line of text."""
    return shown((link(tree, notation),), notation, printed)


def nodes(formula: Printed) -> Iterator[Expr]:
    """All that a formula is made of."""
    return (node for tree in trees(formula) for node in walk(tree))


def trees(formula: Printed) -> Iterator[Expr]:
    """What stands in the chains of a formula."""
    return (link.tree for chain in formula.chains for link in chain if link.tree is not None)


def link(tree: Expr, notation: Notation) -> Link:
    """A tree as one side of an equation."""
    return Link("=", Printer(notation, flat=True).write(tree), tree)


def shown(chain: Chain, notation: Notation, printed: list[Printed]) -> str:
    """A chain in a line of text."""
    printed.append(Printed.inline(one_line(chain), chain, notation))
    return f"${one_line(chain)}$"
