r"""From the statements of an answer to what it says: labels, chains of equal parts, names defined on the way.

`\det J = a_1 a_2 s_2 = 0, \quad s_2 = \sin\theta_2`: a label, the answer set equal to zero, a definition.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from derive.algebra.normal import normal
from derive.answers.latex.functions import RECIPROCALS
from derive.answers.latex.letters import Letters
from derive.answers.latex.names import FUNCTIONS
from derive.answers.latex.parser import read_latex
from derive.answers.latex.scripts import Tokens, scripted, subscripts_first
from derive.answers.latex.statements import Statement, statements
from derive.answers.latex.tokens import tokens
from derive.answers.published import Published
from derive.errors import FormulaError, NotDerivable
from derive.expression import ZERO, Expr, Matrix, Symbol, free_symbols, walk
from derive.expression import replace as replaced

MOST = 20_000  # nodes of an answer with its own names written out
MOST_NAMES = 60
UNREAD = "a part of its chain of equations was not read"
ALONE = "write one answer here; another result stands under its own name in answer:"
APPLIED = FUNCTIONS.keys() | RECIPROCALS.keys()
Read = Callable[[Tokens, Letters], Published]


def read_published(text: str, letters: Letters, whole: Callable[[Expr], Expr]) -> Published:
    """What a LaTeX text says; `whole` works out arithmetic of matrices. Raises FormulaError."""
    main, *rest = statements(subscripts_first(tokens(text)))
    definitions = _definitions(rest, letters)
    known = replace(letters, known=letters.known | set(definitions), own=letters.own | set(definitions))
    found = _chain(main, known, lambda part, names: Published(*read_latex(part, names)).each(whole))
    return found.each(lambda tree: _written_out(tree, definitions)) if definitions else found


def _chain(statement: Statement, letters: Letters, read: Read) -> Published:
    """The parts of a chain that are formulas. Its first part may be the name of what is asked; where it ends
    in zero, the answer is what is set to zero."""
    *before, last = statement.parts
    found, note = [], ""
    for k, part in enumerate(before):
        if k or not _label(part):
            try:
                found.append(read(part, letters))
            except FormulaError:
                note = UNREAD if k else note
    end = read(last, letters)
    if end.tree == ZERO and found:
        end = found.pop()
    return replace(end, chain=tuple(found), note=note)


def _label(part: Tokens) -> str:
    """The name a part consists of, with or without arguments behind it: J, J(q), \\dot{x}; else nothing."""
    first = part[0]
    if first.kind not in ("name", "command") or (first.kind == "command" and first.text in APPLIED):
        return ""
    try:
        name = scripted(part, 0)
    except FormulaError:
        return ""
    rest = part[name.end : -1]
    called = bool(rest) and rest[0].text == "(" and rest[-1].text == ")"
    return name.plain + name.accent if not rest or called else ""


# -- what follows ----------------------------------------------------------------------------------


def _definitions(rest: list[Statement], letters: Letters) -> dict[str, Expr]:
    """Names that the answer defines itself. Raises FormulaError for all else that follows the formula."""
    named = [(_label(statement.parts[0]), statement) for statement in rest]
    for name, statement in named:
        if not name or len(statement.parts) != 2:
            raise FormulaError("what follows the formula is not part of it", statement.offset, ALONE)
    new = {name for name, _ in named if not _meant(name, letters)}
    known = replace(letters, known=letters.known | new, own=letters.own | new)
    found = {}
    for name, statement in named:
        value, tight = read_latex(statement.parts[1], known)
        if tight is not None and tight != value:
            raise FormulaError("a/b c can be read in two ways", statement.offset, "write a/(b c) or (a/b) c")
        if name in new:
            found[name] = value
        elif not _same(_meant(name, letters), value):
            raise FormulaError(
                f"'{name}' is a name of this problem and stands for itself", statement.offset, ALONE
            )
    return found


def _meant(name: str, letters: Letters) -> Expr | None:
    """What a name stands for in the problem itself; a name of the derivation may be defined anew."""
    found = letters.find(name)
    if found in letters.own:
        return Symbol(found)
    return letters.abbreviated(name)


def _same(meant: Expr | None, value: Expr) -> bool:
    if meant is None or isinstance(value, Matrix):
        return False
    try:
        return normal(meant) == normal(value)
    except (NotDerivable, ValueError, ArithmeticError):
        return meant == value


def _written_out(tree: Expr, definitions: dict[str, Expr]) -> Expr:
    """With the names of the answer replaced. Raises FormulaError where that cannot be."""
    writable([tree], definitions)
    values: dict[Expr, Expr] = {Symbol(name): value for name, value in definitions.items()}
    while free_symbols(tree) & set(definitions):
        tree = replaced(tree, values)
    return tree


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
