"""What a sheet takes for known, said once at its head: what c_1 and s_12 stand for, the order of atan2.
Only what stands on its pages is said."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from derive.algebra.readable.operation_count import operations
from derive.expression import Call, Expr, Indexed, Sum, Symbol, walk
from derive.render.known_names import alone, link, named, nodes, shown, trees
from derive.render.layout import Chain
from derive.render.notation import Notation
from derive.render.printed import Printed, Said
from derive.render.skin import environment
from derive.render.trig import SHORT, short_index

MOVES = {"R": ("rotation", 3), "Rot": ("rotation", 4), "Trans": ("translation", 4)}  # the matrices' sizes
SORTS = ("one", "sum", "name")
WORDS = "words/_conventions.j2"


def conventions(said: Sequence[Said], printed: list[Printed], bare: frozenset[str] = frozenset()) -> str:
    """The sentences for what stands in these formulas, "" where there is nothing to say; their own formulas
    are added to `printed`. What was typed in `bare` units stands there as numbers."""
    formulas = [formula for part in said for formula in part.printed if formula.chains]
    short = [*_abbreviated(formulas)]
    seen = [shown(_equation(*each), each[1], printed) for each in _examples(short)]
    also = [
        {"angle": alone(*one[0], printed), "first": alone(*one[1], printed),
         "meant": [shown(_equation(*each), each[1], printed) for each in _both(*one[0])]}
        for one in _renamed(short)
    ]  # fmt: skip
    angle = next(_atan2(formulas), None)
    arctangent = shown((link(*angle),), angle[1], printed) if angle else ""
    several = len(dict.fromkeys(call for call, _ in short)) > len(seen)
    found = environment().get_template(WORDS).render(
        abbreviations=seen, also=also, several=several, arctangent=arctangent,
        moves=[*_moves(formulas, printed)], names=[*named(formulas, printed)], bare=bare,
    )  # fmt: skip
    return found.strip()


def _abbreviated(formulas: Iterable[Printed]) -> Iterator[tuple[Call, Notation]]:
    """Every cosine and sine that is printed by its index."""
    for formula in formulas:
        for tree in trees(formula):
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
        yield from _both(*first[sort])


def _both(angle: Expr, notation: Notation) -> Iterator[tuple[Call, Notation]]:
    yield from ((Call(function, (angle,)), notation) for function in SHORT)


def _renamed(
    found: Sequence[tuple[Call, Notation]],
) -> Iterator[tuple[tuple[Expr, Notation], tuple[Expr, Notation]]]:
    """Angles that have the index of the first one and are called by another letter, each beside that."""
    first: tuple[Expr, Notation] | None = None
    seen: set[Expr] = set()
    for call, notation in found:
        (angle,) = call.arguments
        if not isinstance(angle, Symbol) or angle.name in notation.short_names or angle in seen:
            continue
        first = first or (angle, notation)
        seen.add(angle)
        if angle != first[0] and short_index(angle, notation) == short_index(*first):
            yield (angle, notation), first


def _atan2(formulas: Iterable[Printed]) -> Iterator[tuple[Call, Notation]]:
    for formula in formulas:
        for tree in trees(formula):
            if any(isinstance(node, Call) and node.function == "atan2" for node in walk(tree)):
                yield Call("atan2", (Symbol("y"), Symbol("x"))), formula.notation


def _moves(formulas: Iterable[Printed], printed: list[Printed]) -> Iterator[dict[str, str | int]]:
    """A rotation and a translation of each way to call them, R_{z,phi}: by a name where there is one, else by
    the shortest amount."""
    found: dict[str, dict[Indexed, Notation]] = {}
    for formula in formulas:
        for node in nodes(formula):
            match node:
                case Indexed(base, (Symbol("x" | "y" | "z"), _)) if base in MOVES:
                    found.setdefault(base, {}).setdefault(node, formula.notation)
    for base, moves in found.items():
        move = min(moves, key=lambda move: (not isinstance(move.lower[1], Symbol), operations(move.lower[1])))
        axis, amount = move.lower
        parts = {"name": move, "amount": amount, "axis": axis}
        sort, size = MOVES[base]
        said = {key: alone(tree, moves[move], printed) for key, tree in parts.items()}
        yield {**said, "sort": sort, "size": size}


def _equation(call: Call, notation: Notation) -> Chain:
    """c_1 = \\cos \\theta_1."""
    return (link(call, notation), link(call, replace(notation, trig="long")))
