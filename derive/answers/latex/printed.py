r"""Our own pages read: what TeX would make of their LaTeX, and nothing that TeX would refuse.

A published answer is taken as people mean it, `x^-1` and `\theta_12` too; on a page of ours these are
mistakes of its printer. What has more than one line is laid out again before it is read.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence

from derive.algebra.formulas.tokens import Token
from derive.answers.latex.letters import LETTERS, Letters
from derive.answers.latex.names import FUNCTIONS
from derive.answers.latex.parser import read_latex
from derive.answers.latex.scripts import Tokens, group, subscripts_first
from derive.answers.latex.tokens import tokens
from derive.errors import FormulaError
from derive.expression import Call, Expr, Indexed, Symbol, walk

FENCES = re.compile(
    r"\\(?P<fence>left|right)(?![A-Za-z])\s*(?P<of>[()\[\]|.]|\\[{}|])?"
    r"|\\(?P<env>begin|end)(?![A-Za-z])\{(?P<name>[a-z*]+)\}|(?<!\\)(?P<brace>[{}])"
)
SIGNS = {"=": "=", "approx": r"\approx", "<": "<", ">": ">", "leq": "<=", "geq": ">=", "neq": "!="}
OPENS, CLOSES = ("(", "[", "{"), (")", "]", "}")
READ_FUNCTIONS = frozenset(FUNCTIONS.values())
OURS = READ_FUNCTIONS | {"transpose", "inverse", "cross", "bracket", "exp"}

Part = tuple[str, Tokens]  # the sign before an expression, and the expression with an end token
Open = tuple[str, list[Token]]  # one that is being read


def letters_of(trees: Iterable[Expr], xy: bool) -> Letters:
    """The names that may stand where these trees were printed."""
    nodes = [node for tree in trees for node in walk(tree)]
    names = frozenset(node.name for node in nodes if isinstance(node, Symbol))
    called = {node.function for node in nodes if isinstance(node, Call)}
    indexed = frozenset(node.base for node in nodes if isinstance(node, Indexed) and node.lower)
    functions = frozenset(called - OURS)
    return Letters(names | functions, xy, names | functions, True, indexed, functions, "transpose" in called)


def read_part(part: Tokens, tree: Expr, xy: bool) -> Expr:
    """What an expression says, in the names of the tree it was printed from. Raises FormulaError."""
    return read_latex(part, letters_of([tree], xy))[0]


def parts_of(lines: Sequence[str]) -> list[list[Part]]:
    """The chains that stand in the lines of a display, or in one of a text. Raises FormulaError where TeX
    would refuse a line."""
    chains: list[list[Open]] = []
    depth = 0
    for line in lines:
        found = require_tex(line)
        if found[0].text in ("_", "^"):
            raise FormulaError(f"this {found[0].text} stands on nothing", 0)
        depth = _line(found, chains, depth)
    return [[(sign, _ended(part)) for sign, part in chain] for chain in chains]


def require_tex(line: str) -> Tokens:
    """The tokens of a line. Raises FormulaError where TeX would refuse it."""
    _require_fences(line)
    found = subscripts_first(tokens(line))
    _require_scripts(found)
    return found


def _line(found: Tokens, chains: list[list[Open]], depth: int) -> int:
    """Adds what stands in a line; how deep in parentheses it ends, which the next goes on with."""
    first, *others = found
    goes_on = first.text == "&" and (depth > 0 or others[0].text in SIGNS or others[0].kind == "gap")
    if not goes_on:
        chains.append([("=", [])])
    for k, token in enumerate(found[:-1]):
        after = found[k + 1]
        if token.text in CLOSES or (token.text == "end" and token.kind == "command"):
            depth -= 1
        aligns = token.text == "&" and (depth == 0 or after.kind == "gap" or k == 0)
        if token.kind == "gap" and depth == 0 and "qquad" in token.text:
            chains.append([("=", [])])
        elif token.text in SIGNS and depth == 0:
            chains[-1].append((SIGNS[token.text], []))
        elif token.kind != "gap" and not aligns:
            chains[-1][-1][1].append(token)
        if token.text in OPENS or (token.text == "begin" and token.kind == "command"):
            depth += 1
    return depth


def _ended(part: Sequence[Token]) -> Tokens:
    if not part:
        raise FormulaError("an expression is missing", 0)
    return (*part, Token("end", "", part[-1].end, part[-1].end))


# -- what TeX asks for --------------------------------------------------------------------------------


def _require_fences(line: str) -> None:
    r"""Raises FormulaError where braces, \left and \right, \begin and \end do not close each other."""
    opened: list[str] = []
    for found in FENCES.finditer(line):
        what = found["brace"] or found["fence"] or f"{found['env']} {found['name']}"
        if found["fence"] and not found["of"]:
            raise FormulaError(f"\\{what} asks for a delimiter", found.start())
        if what in ("{", "left") or found["env"] == "begin":
            opened.append({"{": "}", "left": "right"}.get(what, f"end {found['name']}"))
        elif not opened or opened.pop() != what:
            raise FormulaError(f"'{found[0]}' closes nothing", found.start())
    if opened:
        raise FormulaError("something is opened and not closed", len(line))


def _require_scripts(found: Tokens) -> None:
    """Raises FormulaError for an index without braces that is more than one sign, and for two of a kind."""
    at, before, used = 0, "", set[str]()
    while found[at].kind != "end":
        token = found[at]
        if token.text not in ("_", "^"):
            before, used = token.text, set()
            at += 1
            continue
        if token.text in used or (before and before in "+-=(&"):
            raise FormulaError(f"this {token.text} stands on nothing", token.offset)
        used.add(token.text)
        inner, after = group(found, at + 1)
        if found[at + 1].text != "{" and not _is_one_sign(found[at + 1]):
            raise FormulaError("an index of several signs stands in braces", token.offset)
        if found[at + 1].text == "{":
            _require_scripts(_ended(inner))
        at = after


def _is_one_sign(token: Token) -> bool:
    commands: Collection[str] = LETTERS | {"circ", "ast"}
    if token.kind == "command":
        return token.text in commands
    return len(token.text) == 1 and (token.kind in ("name", "number") or token.text == "+")
