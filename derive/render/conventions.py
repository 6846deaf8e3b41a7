"""What a sheet takes for known, said once at its head: what c_1 and s_12 stand for, the order of atan2.
Only what stands on its pages is said."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from derive.expression import Call, Expr, Indexed, Sum, Symbol, walk
from derive.render.latex import Printer
from derive.render.layout import Chain, Link, one_line
from derive.render.notation import Notation
from derive.render.printed import Printed, Said
from derive.render.skin import environment
from derive.render.trig import SHORT, short_index

MOVES = {"R": "rotation", "Rot": "rotation", "Trans": "translation"}
ENTRY = re.compile(r"(?P<letter>[a-z])_(?P<row>\d)(?P<column>\d)")
AXES = ("x", "y", "z")
FRAMED = re.compile(r"(?P<letter>[TR])_(?P<frames>\d+\^\d+)")
SORTS = ("one", "sum", "name")
WORDS = "words/_conventions.j2"


def conventions(said: Sequence[Said], printed: list[Printed]) -> str:
    """The sentences for what stands in these formulas, "" where there is nothing to say; their own formulas
    are added to `printed`."""
    formulas = [formula for part in said for formula in part.printed if formula.chains]
    short = [*_abbreviated(formulas)]
    seen = [_shown(_equation(*each), each[1], printed) for each in _examples(short)]
    angle = next(_atan2(formulas), None)
    arctangent = _shown((_link(*angle),), angle[1], printed) if angle else ""
    several = len(dict.fromkeys(call for call, _ in short)) > len(seen)
    found = environment().get_template(WORDS).render(
        abbreviations=seen, several=several, arctangent=arctangent, moves=[*_moves(formulas, printed)],
        entry=_entry(formulas, printed), part=_part(formulas, printed),
        component=_component(formulas, printed),
    )  # fmt: skip
    return found.strip()


def _abbreviated(formulas: Iterable[Printed]) -> Iterator[tuple[Call, Notation]]:
    """Every cosine and sine that is printed by its index."""
    for formula in formulas:
        for tree in _trees(formula):
            for node in walk(tree):
                match node:
                    case Call(function, (angle,)) if function in SHORT and short_index(
                        angle, formula.notation
                    ):
                        yield node, formula.notation


def _examples(found: Sequence[tuple[Call, Notation]]) -> Iterator[tuple[Call, Notation]]:
    """A cosine and a sine of the first angle, of the first sum, and of the first that goes by its name."""
    first: dict[str, tuple[Expr, Notation]] = {}
    for call, notation in found:
        (angle,) = call.arguments
        named = isinstance(angle, Symbol) and angle.name in notation.short_names
        first.setdefault("sum" if isinstance(angle, Sum) else "name" if named else "one", (angle, notation))
    for sort in filter(first.get, SORTS):
        angle, notation = first[sort]
        yield from ((Call(function, (angle,)), notation) for function in SHORT)


def _atan2(formulas: Iterable[Printed]) -> Iterator[tuple[Call, Notation]]:
    for formula in formulas:
        for tree in _trees(formula):
            if any(isinstance(node, Call) and node.function == "atan2" for node in walk(tree)):
                yield Call("atan2", (Symbol("y"), Symbol("x"))), formula.notation


def _moves(formulas: Iterable[Printed], printed: list[Printed]) -> Iterator[dict[str, str]]:
    """The first elementary rotation and the first translation of each way to call them: R_{z,phi}."""
    met = set[str]()
    for formula in formulas:
        for node in _nodes(formula):
            match node:
                case Indexed(base, (Symbol(axis), amount)) if (
                    base in MOVES and base not in met and axis in "xyz"
                ):
                    met.add(base)
                    parts = {"name": node, "amount": amount, "axis": Symbol(axis)}
                    shown = {key: _alone(tree, formula.notation, printed) for key, tree in parts.items()}
                    yield {**shown, "sort": MOVES[base]}


def _entry(formulas: Iterable[Printed], printed: list[Printed]) -> dict[str, str] | None:
    """The first entry of a matrix that goes by a small letter: r_12 of R."""
    matrices = {node.name for each in formulas for node in _nodes(each) if isinstance(node, Symbol)}
    for formula in formulas:
        for node in _nodes(formula):
            found = isinstance(node, Symbol) and ENTRY.fullmatch(node.name)
            if found and found["letter"].upper() in matrices:
                parts = {"name": node, "matrix": Symbol(found["letter"].upper())}
                shown = {key: _alone(tree, formula.notation, printed) for key, tree in parts.items()}
                return {**shown, "row": found["row"], "column": found["column"]}
    return None


def _part(formulas: Iterable[Printed], printed: list[Printed]) -> dict[str, str] | None:
    """Where R_i^j stands beside T_i^j."""
    frames = {"T": set[str](), "R": set[str]()}
    for formula in formulas:
        for node in _nodes(formula):
            if isinstance(node, Symbol) and (found := FRAMED.fullmatch(node.name)):
                frames[found["letter"]].add(found["frames"])
                if both := sorted(frames["T"] & frames["R"]):
                    names = {"R": f"R_{both[0]}", "T": f"T_{both[0]}"}
                    return {
                        key: _alone(Symbol(name), formula.notation, printed) for key, name in names.items()
                    }
    return None


def _component(formulas: Iterable[Printed], printed: list[Printed]) -> dict[str, str] | None:
    """The first component of a vector of three that goes by its letter: omega_x of omega."""
    names = {node.name for each in formulas for node in _nodes(each) if isinstance(node, Symbol)}
    for formula in formulas:
        for node in _nodes(formula):
            if isinstance(node, Symbol) and node.name.endswith("_x"):
                vector = node.name.removesuffix("_x")
                if {vector, f"{vector}_y", f"{vector}_z"} <= names:
                    parts = {"name": node, "vector": Symbol(vector)}
                    return {key: _alone(tree, formula.notation, printed) for key, tree in parts.items()}
    return None


def _alone(tree: Expr, notation: Notation, printed: list[Printed]) -> str:
    return _shown((_link(tree, notation),), notation, printed)


def _nodes(formula: Printed) -> Iterator[Expr]:
    return (node for tree in _trees(formula) for node in walk(tree))


def _trees(formula: Printed) -> Iterator[Expr]:
    return (link.tree for chain in formula.chains for link in chain if link.tree is not None)


def _equation(call: Call, notation: Notation) -> Chain:
    """c_1 = \\cos \\theta_1."""
    return (_link(call, notation), _link(call, replace(notation, trig="long")))


def _link(tree: Expr, notation: Notation) -> Link:
    return Link("=", Printer(notation).write(tree), tree)


def _shown(chain: Chain, notation: Notation, printed: list[Printed]) -> str:
    printed.append(Printed.inline(one_line(chain), chain, notation))
    return f"${one_line(chain)}$"
