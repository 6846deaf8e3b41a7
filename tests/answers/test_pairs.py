"""Published answers made of derived ones: rewritten by SymPy they are never called different, changed in one
place never equal. The truth is found by mpmath to 40 digits, from formulas that SymPy holds."""

from __future__ import annotations

import random
import re
from dataclasses import dataclass
from functools import cache

import mpmath
import pytest
import sympy as sp
from sympy.simplify.fu import TR8

from derive.algebra.infix import text
from derive.answers.asked import Asked
from derive.answers.checking import read_both_ways
from derive.answers.reading import read_text
from derive.build import working_on
from derive.expression import Expr, Matrix
from derive.kinds.problem import TREES
from derive.sheet.load import load_sheet
from derive.verify import answered
from tests.sheets import ROOT

SHEETS = ("planar-2r", "week3", "lagrange", "dc-motor")
PAIRS = 40  # of a sheet
LONGEST = 60  # operations
GREEK = ("alpha", "beta", "gamma", "delta", "theta", "phi", "psi", "omega", "tau", "zeta")
FUNCTIONS = {"sin", "cos", "tan", "sqrt", "exp", "log", "acos", "asin", "atan", "atan2", "Abs", "sign", "pi"}
AROUND = (
    "{}", "X = {}", "X := {}", r"X &= {}", r"\boxed{{X = {}}}", r"{} \tag{{3}}", r"{}, \quad (2.4)", "{}.",
    r"\begin{{align*}} X &= {} \end{{align*}}", r"\[ {} \]", r"{} \in \mathbb{{R}}", r"{} % from the old key",
    r"\begin{{equation}} X(q) = {} \label{{eq:x}} \end{{equation}}", r"{0} = {0}", r"\left( {} \right)",
)  # fmt: skip


@dataclass(frozen=True)
class Entry:
    """One entry of a result, as a tree and for SymPy."""

    asked: Asked
    name: str
    tree: Expr
    formula: sp.Expr


@cache
def entries(sheet: str) -> list[Entry]:
    """Every entry of every result of a sheet of the exercises that is short enough to be rewritten."""
    found = []
    for problem in load_sheet(ROOT / "exercises" / f"{sheet}.yaml").problems:
        working = working_on(problem)
        for question in problem.questions:
            derivation, at = answered(question, working), question.answer_at
            assert at is not None
            asked = Asked(problem.number, question.number, derivation, working, {}, at.place, at.key)
            for name, result in derivation.results.items():
                if isinstance(result, TREES):
                    readable = (tree for tree in scalars(result) if "lambda" not in text(tree))
                    found += [Entry(asked, name, tree, for_sympy(tree)) for tree in readable]
    return [each for each in found if each.formula.free_symbols and each.formula.count_ops() <= LONGEST]


def scalars(result: Expr) -> list[Expr]:
    return [entry for row in result.rows for entry in row] if isinstance(result, Matrix) else [result]


def for_sympy(tree: Expr) -> sp.Expr:
    written = text(tree)
    names = set(re.findall(r"[A-Za-z_]\w*", written)) - FUNCTIONS
    return sp.sympify(written, locals={name: sp.Symbol(name, real=True) for name in names})


def rewritten(draw: random.Random, formula: sp.Expr) -> sp.Expr:
    """The same in another form."""
    turning = sorted(formula.atoms(sp.sin, sp.cos), key=str)
    match draw.randrange(8):
        case 0:
            return sp.expand(formula)
        case 1:
            return sp.factor(formula)
        case 2:
            return sp.expand_trig(formula)
        case 3:
            return TR8(formula)
        case 4 if turning:
            angle = draw.choice(turning).args[0]
            half = sp.tan(angle / 2)
            return formula.xreplace({sp.sin(angle): 2 * half / (1 + half**2)})
        case 5 if turning:
            angle = draw.choice(turning).args[0]
            return formula.xreplace({sp.cos(angle): 1 - 2 * sp.sin(angle / 2) ** 2})
        case 6 if turning:
            angle = draw.choice(turning).args[0]
            return formula.xreplace({sp.cos(angle): sp.sin(sp.pi / 2 - angle, evaluate=False)})
        case _:
            return sp.together(formula)


def spoiled(draw: random.Random, formula: sp.Expr) -> sp.Expr:
    """The same with a slip in it."""
    symbols = sorted(formula.free_symbols, key=str)
    terms = list(sp.Add.make_args(sp.expand(formula)))
    place = draw.randrange(len(terms))
    match draw.randrange(5):
        case 0:
            return -formula
        case 1:
            return formula * draw.choice([2, 3, sp.Rational(1, 2)])
        case 2 if len(symbols) > 1:
            one, other = draw.sample(symbols, 2)
            return formula.xreplace({one: other})
        case 3 if symbols:
            name = draw.choice(symbols)
            return formula.xreplace({name: name**2})
        case _:
            return sp.Add(*terms[:place], -terms[place], *terms[place + 1 :])


def are_equal(draw: random.Random, one: sp.Expr, other: sp.Expr) -> bool:
    """Whether they agree to 25 digits at several points."""
    names = sorted(one.free_symbols | other.free_symbols, key=str)
    with mpmath.workdps(40):
        functions = [sp.lambdify(names, formula, "mpmath") for formula in (one, other)]
        for _ in range(4):
            point = [mpmath.mpf(draw.randint(200, 1900)) / 1000 for _ in names]
            left, right = (function(*point) for function in functions)
            if abs(left - right) > mpmath.mpf(10) ** -25 * max(1, abs(left)):
                return False
    return True


def published(draw: random.Random, formula: sp.Expr) -> str:
    """As SymPy types or prints it, with what an old key has around it."""
    if draw.random() < 0.3:
        return str(formula)
    folded = draw.random() < 0.3
    names = {symbol: latex_name(str(symbol)) for symbol in formula.free_symbols}
    printed = sp.latex(formula, symbol_names=names, fold_short_frac=folded)
    return draw.choice(AROUND[:9] if folded else AROUND).format(printed)


def latex_name(name: str) -> str:
    plain, accent = name, ""
    for rate, command in (("_ddot", r"\ddot"), ("_dot", r"\dot")):
        if name.endswith(rate):
            plain, accent = name.removesuffix(rate), command
            break
    found = re.fullmatch(r"([A-Za-z]+)_?(.*)", plain)
    assert found is not None
    letter = f"\\{found[1]}" if found[1] in GREEK else found[1]
    letter = f"{accent}{{{letter}}}" if accent else letter
    return f"{letter}_{{{found[2]}}}" if found[2] else letter


@pytest.mark.parametrize("sheet", SHEETS)
def test_no_false_verdict(sheet: str) -> None:
    draw = random.Random(sheet)
    for entry in draw.choices(entries(sheet), k=PAIRS):
        right = draw.random() < 0.6
        formula = (rewritten if right else spoiled)(draw, entry.formula)
        typed = published(draw, formula)
        read = read_text(typed, entry.asked.letters)
        found = read_both_ways(read, entry.tree, entry.asked.terms_of(entry.name))
        wanted = "equal" if right or are_equal(draw, formula, entry.formula) else "differs"
        assert found.verdict == wanted, (entry.name, typed, text(entry.tree), found)
