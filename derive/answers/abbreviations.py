"""Names that an answer defines for itself: what they would come to, written out."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from derive.errors import FormulaError
from derive.expression import Expr, Symbol, walk

MOST = 20_000  # nodes of an answer with its own names written out
MOST_NAMES = 60


def writable(trees: Iterable[Expr], definitions: Mapping[str, Expr]) -> None:
    """Raises FormulaError where definitions go round in a circle, or come to more than anybody could mean:
    k_1 = k_2 k_2, k_2 = k_3 k_3, ..."""
    if len(definitions) > MOST_NAMES:
        raise FormulaError(f"an answer defines at most {MOST_NAMES} names of its own", 0)
    sizes: dict[str, int] = {}
    for tree in trees:
        if _size(tree, definitions, sizes, ()) > MOST:
            raise FormulaError("the answer is too long with its own names written out", 0)


def _size(tree: Expr, definitions: Mapping[str, Expr], sizes: dict[str, int], within: tuple[str, ...]) -> int:
    total = 0
    for node in walk(tree):
        name = node.name if isinstance(node, Symbol) and node.name in definitions else ""
        if name in within and name:
            raise FormulaError(f"the definition of '{name}' goes round in a circle", 0)
        if name and name not in sizes:
            sizes[name] = _size(definitions[name], definitions, sizes, (*within, name))
        total += sizes[name] if name else 1
    return total
