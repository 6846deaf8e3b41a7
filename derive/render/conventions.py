"""What a sheet takes for known, said once at its head: what c_1 and s_12 stand for, the order of atan2.
Only what stands on its pages is said."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from derive.expression import Call, Expr, Sum, Symbol, walk
from derive.render.latex import Printer
from derive.render.layout import Chain, Link, one_line
from derive.render.notation import Notation
from derive.render.printed import Printed, Said
from derive.render.skin import environment
from derive.render.trig import SHORT, short_index

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
    page = (
        environment().get_template(WORDS).render(abbreviations=seen, several=several, arctangent=arctangent)
    )
    return page.strip()


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
