"""What a slip looks like in code: a sign, an index, a factor. One mistake at one place of a function."""

from __future__ import annotations

import ast
import copy
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from types import CodeType
from typing import Any

from derive.render.skin import templates
from tests.sheets import ROOT

Operator = Callable[[ast.AST], ast.AST | None]  # the node with the mistake; None where it has no place for it
STRATA = {
    "mechanics": "mechanics",
    "kinds": "kinds",
    "control": "control",
    "algebra": "algebra",
    "render": "render",
}
WORDS = "templates"
# The code that checks is not under trial: what it lets through is found by mistakes in the code that answers.
CHECKS = re.compile(
    r"oracle|claim|check|audit|plausible|agree|verif|read_back|_law$|_laws$|links?$|proof|prove"
)
OPPOSITE = {ast.Add: ast.Sub, ast.Sub: ast.Add}
COMPARED = {
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
}  # fmt: skip
TWINS = {"sin": "cos", "cos": "sin", "SIN": "COS", "COS": "SIN", "rows": "columns"}


@dataclass(frozen=True, slots=True)
class Mutant:
    """A mistake: where it is, what was there, and what stands there now."""

    stratum: str
    operator: str
    path: Path
    line: int
    function: str  # its qualified name; a template has none
    number: int  # of the mutation among those of this operator in the file
    before: str
    after: str

    def __str__(self) -> str:
        place = f"{self.path.relative_to(ROOT)}:{self.line}"
        return f"{self.operator:<12} {place} {self.function}  {self.before} -> {self.after}"


def _sign(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.BinOp(op=ast.Add() | ast.Sub()) if not _texts(node):
            return ast.BinOp(node.left, OPPOSITE[type(node.op)](), node.right)
        case ast.UnaryOp(op=ast.USub(), operand=operand) if not isinstance(operand, ast.Constant):
            return operand
        case ast.Call(func=ast.Name(id="negate"), args=[only]):
            return only
    return None


def _twin(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Name(id=name) if name in TWINS:
            return ast.Name(TWINS[name], node.ctx)
        case ast.Constant(value=str(name)) if name in TWINS:
            return ast.Constant(TWINS[name])
    return None


def _indices(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Subscript(slice=ast.Tuple(elts=[i, j])) if ast.dump(i) != ast.dump(j):
            return ast.Subscript(node.value, ast.Tuple([j, i], ast.Load()), node.ctx)
        case ast.Subscript(value=ast.Subscript(value=inner, slice=i, ctx=c), slice=j) if ast.dump(
            i
        ) != ast.dump(j):
            return ast.Subscript(ast.Subscript(inner, j, c), i, node.ctx)
    return None


def _off_by_one(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Subscript(slice=ast.Constant(value=int(i))):
            return ast.Subscript(node.value, ast.Constant(i + 1 if i < 1 else i - 1), node.ctx)
        case ast.Subscript(slice=ast.Name() | ast.BinOp() as i):
            return ast.Subscript(node.value, ast.BinOp(i, ast.Sub(), ast.Constant(1)), node.ctx)
        case ast.Call(func=ast.Name(id="range"), args=[*first, last]):
            return ast.Call(node.func, [*first, ast.BinOp(last, ast.Sub(), ast.Constant(1))], [])
    return None


def _transposed(node: ast.AST) -> ast.AST | None:
    return node.value if isinstance(node, ast.Attribute) and node.attr == "T" else None


def _factor(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.BinOp(op=ast.Mult()) if not _texts(node):
            return node.right
        case ast.BinOp(op=ast.Div(), left=top):
            return ast.BinOp(top, ast.Mult(), node.right) if not _texts(node) else None
        case ast.Constant(value=2):
            return ast.Constant(1)
    return None


def _dropped(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.BinOp(op=ast.Add(), left=left) if not _texts(node):
            return left
        case ast.BinOp(op=ast.Sub(), left=left):
            return left
        case ast.Call(func=ast.Name(id="sum"), args=[only]):
            return ast.Call(node.func, [_but_first(only)], [])
    return None


def _swapped(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Call(args=[first, second, *rest]) if ast.dump(first) != ast.dump(second):
            if not any(isinstance(each, ast.Starred) for each in node.args):
                return ast.Call(node.func, [second, first, *rest], node.keywords)
    return None


def _post_for_pre(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.BinOp(op=ast.MatMult()):
            return ast.BinOp(node.right, node.op, node.left)
    return None


def _compared(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Compare(ops=[op]) if type(op) in COMPARED:
            return ast.Compare(node.left, [COMPARED[type(op)]()], node.comparators)
    return None


def _constant(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.Constant(value=bool(truth)):
            return ast.Constant(not truth)
        case ast.Constant(value=0 | 1 as number):
            return ast.Constant(1 - number)
        case ast.Name(id="ZERO" | "ONE" as name):
            return ast.Name("ONE" if name == "ZERO" else "ZERO", node.ctx)
    return None


def _branch(node: ast.AST) -> ast.AST | None:
    match node:
        case ast.If(test=test):
            return ast.If(ast.UnaryOp(ast.Not(), test), node.body, node.orelse)
        case ast.IfExp():
            return ast.IfExp(node.test, node.orelse, node.body)
        case (
            ast.ListComp(generators=[ast.comprehension(ifs=[test, *_])])
            | ast.GeneratorExp(generators=[ast.comprehension(ifs=[test, *_])])
        ):
            made = copy.deepcopy(node)
            made.generators[0].ifs[0] = ast.UnaryOp(ast.Not(), test)
            return made
    return None


def _texts(node: ast.BinOp) -> bool:
    """Whether texts or lists are joined there, and nothing is added."""
    parts = (node.left, node.right)
    return any(isinstance(p, ast.JoinedStr | ast.List | ast.Tuple | ast.ListComp) for p in parts) or any(
        isinstance(p, ast.Constant) and isinstance(p.value, str) for p in parts
    )


def _but_first(items: ast.expr) -> ast.expr:
    rest = ast.Slice(ast.Constant(1), None, None)
    listed = ast.Call(ast.Name("list", ast.Load()), [items], [])
    return ast.Subscript(listed, rest, ast.Load())


CODE: dict[str, Operator] = {
    "sign": _sign, "sin-cos": _twin, "index-swap": _indices, "off-by-one": _off_by_one,
    "transpose": _transposed, "factor": _factor, "drop-term": _dropped, "arg-swap": _swapped,
    "pre-post": _post_for_pre, "comparison": _compared, "zero-one": _constant, "branch": _branch,
}  # fmt: skip


def in_code(stratum: str) -> Iterator[Mutant]:
    """Every mistake that can be planted into the functions of a stratum."""
    for path in sorted((ROOT / "derive" / STRATA[stratum]).rglob("*.py")):
        if CHECKS.search(path.stem):
            continue
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for name, operator in CODE.items():
            for number, (node, wrong, function) in enumerate(_places(tree, operator)):
                if not any(CHECKS.search(part) for part in function.split(".")):
                    line = getattr(node, "lineno", 0)
                    yield Mutant(
                        stratum, name, path, line, function, number, _told(node), _told(wrong)
                    )  # fmt: skip


def code_of(mutant: Mutant) -> CodeType:
    """The function with the mistake, compiled as part of its module."""
    tree = ast.parse(mutant.path.read_text(encoding="utf-8"))
    node, wrong, _ = list(_places(tree, CODE[mutant.operator]))[mutant.number]
    whole = compile(put(tree, node, wrong), str(mutant.path), "exec")
    return next(code for code in _codes(whole) if code.co_qualname == mutant.function)


def _codes(code: CodeType) -> Iterator[CodeType]:
    yield code
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from _codes(constant)


def _places(tree: ast.Module, operator: Operator) -> Iterator[tuple[ast.AST, ast.AST, str]]:
    """(node, the same with the mistake, the outermost function it is in) in the order of the file."""
    for function, name in _functions(tree, ""):
        for statement in function.body:
            for node in _inside(statement):
                if (wrong := operator(node)) is not None:
                    yield node, ast.copy_location(wrong, node), name


def _functions(tree: ast.Module | ast.ClassDef, prefix: str) -> Iterator[tuple[ast.FunctionDef, str]]:
    for node in tree.body:
        if isinstance(node, ast.FunctionDef):
            yield node, f"{prefix}{node.name}"
        elif isinstance(node, ast.ClassDef):
            yield from _functions(node, f"{prefix}{node.name}.")


def _inside(statement: ast.AST) -> Iterator[ast.AST]:
    """Its nodes, but no docstrings, types and messages of errors."""
    if isinstance(statement, ast.Raise | ast.Assert | ast.Import | ast.ImportFrom):
        return
    if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
        return
    yield statement
    for name, value in ast.iter_fields(statement):
        if name not in ("annotation", "returns", "decorator_list"):
            for part in value if isinstance(value, list) else [value]:
                if isinstance(part, ast.AST):
                    yield from _inside(part)


def put(tree: ast.AST, node: ast.AST, wrong: ast.AST) -> Any:
    """The tree, changed: with another node in the place of one."""
    return ast.fix_missing_locations(_Put(node, wrong).visit(tree))


class _Put(ast.NodeTransformer):
    def __init__(self, node: ast.AST, wrong: ast.AST) -> None:
        self.node, self.wrong = node, wrong

    def visit(self, node: ast.AST) -> ast.AST:
        return self.wrong if node is self.node else self.generic_visit(node)


def _told(node: ast.AST) -> str:
    text = " ".join(ast.unparse(ast.fix_missing_locations(copy.deepcopy(node))).split())
    return text if len(text) < 70 else text[:67] + "..."


# -- words -----------------------------------------------------------------------------------------

NO_SOLUTION = re.compile(r"\{% block (question|results|example) %\}.*?\{% endblock %\}", re.S)
VERDICTS = [
    ("left", "right"), ("stable", "unstable"), ("up", "down"), ("minimum", "maximum"),
    ("positive", "negative"), ("row", "column"), ("before", "after"), ("first", "last"),
    ("constant", "variable"), ("larger", "smaller"),
]  # fmt: skip
SWAPS = [pair for a, b in VERDICTS for pair in ((a, b), (b, a))]
WORDINGS: dict[str, re.Pattern[str]] = {
    "typed-sign": re.compile(r"(?<=[$({ \w}])([+-])(?= [\\\w{])"),
    "typed-index": re.compile(r"(?<=_)(\d|i|j|\{i-1\}|\{i\})"),
    "word": re.compile(r"\b(" + "|".join(a for a, _ in SWAPS) + r")\b"),
    "condition": re.compile(r"\{% (?:el)?if (?!not )([^%]+?) %\}"),
    "lines": re.compile(r"^(\{\{ show[^\n]*\}\})\n(.+)\n(\{\{ show[^\n]*\}\})", re.M),
}  # fmt: skip


def in_words() -> Iterator[Mutant]:
    """Every mistake that can be planted into the sentences of a solution."""
    for path in sorted(Path(templates()).glob("words/**/*.j2")):
        text = path.read_text(encoding="utf-8")
        others = [found.span() for found in NO_SOLUTION.finditer(text)]
        for name, pattern in WORDINGS.items():
            for number, found in enumerate(pattern.finditer(text)):
                if not any(start <= found.start() < end for start, end in others):
                    line = text.count("\n", 0, found.start(found.lastindex or 0)) + 1
                    yield Mutant(
                        WORDS, name, path, line, "", number,
                        found.group()[:60], _reworded(name, found)[:60],
                    )  # fmt: skip


def words_of(mutant: Mutant) -> str:
    """The text of the template with the mistake."""
    text = mutant.path.read_text(encoding="utf-8")
    found = list(WORDINGS[mutant.operator].finditer(text))[mutant.number]
    return text[: found.start()] + _reworded(mutant.operator, found) + text[found.end() :]


def _reworded(name: str, found: re.Match[str]) -> str:
    whole, (start, end) = found.group(), found.span(1)
    inner, offset = found.group(1), found.start()
    match name:
        case "typed-sign":
            new = "-" if inner == "+" else "+"
        case "typed-index":
            new = {"i": "j", "j": "i", "{i-1}": "{i}", "{i}": "{i-1}"}.get(inner) or str(int(inner) + 1)
        case "word":
            new = dict(SWAPS)[inner]
        case "condition":
            new = f"not ({inner})"
        case _:
            return f"{found.group(3)}\n{found.group(2)}\n{inner}"
    return whole[: start - offset] + new + whole[end - offset :]
