"""Whole answers as people write them: matrices and sets of solutions, rewritten and set by hand. What is
right is equal, a mistake is found where it was made, and no mistake is ever called equal."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import pytest
import sympy as sp

from derive.algebra.infix import text
from derive.answers.asked import Asked
from derive.answers.checking import checks
from derive.build import working_on
from derive.check import reached
from derive.expression import Matrix
from derive.kinds.problem import TREES
from derive.sheet.load import load_sheet
from derive.verify import answered
from tests.answers.by_hand import Hand
from tests.answers.test_pairs import are_equal, for_sympy, rewritten
from tests.sheets import ROOT

SHEETS = ("planar-2r", "week3", "week4", "lagrange", "dc-motor")
ANSWERS = 12  # of a sheet
SETS = 12
LONGEST = 700  # characters of an entry
SWAPPED = {sp.sin: sp.cos, sp.cos: sp.sin}


@cache
def questions(sheet: str) -> list[Asked]:
    """The questions of a sheet of the exercises, without answers yet."""
    found = []
    for problem in load_sheet(ROOT / "exercises" / f"{sheet}.yaml").problems:
        working = working_on(problem)
        for question in problem.questions:
            derivation, at = answered(question, working), question.answer_at
            assert at is not None
            points = reached(question, working, derivation)
            found.append(
                Asked(
                    problem.number, question.number, derivation, working, {}, at.place, at.key,
                    reached=points, evaluate=question.evaluate,
                )
            )  # fmt: skip
    return found


def results(sheet: str) -> Iterator[tuple[Asked, str, list[list[sp.Expr]]]]:
    """Every result that is a scalar or a matrix, as rows for SymPy."""
    for asked in questions(sheet):
        for name, result in asked.derivation.results.items():
            if not isinstance(result, TREES):
                continue
            rows = result.rows if isinstance(result, Matrix) else ((result,),)
            written = [text(entry) for row in rows for entry in row]
            if max(map(len, written)) <= LONGEST and not any("lambda" in each for each in written):
                yield asked, name, [[for_sympy(entry) for entry in row] for row in rows]


def mistaken(draw: random.Random, formula: sp.Expr) -> sp.Expr:
    """The formula with one slip of the pen."""
    calls = sorted(formula.atoms(sp.sin, sp.cos), key=str)
    names = sorted(formula.free_symbols, key=str)
    terms = list(sp.Add.make_args(sp.expand(formula)))
    place = draw.randrange(len(terms))
    match draw.randrange(6):
        case 0 if calls:
            call = draw.choice(calls)
            return formula.xreplace({call: SWAPPED[type(call)](*call.args)})
        case 1 if calls:  # an angle more
            call = draw.choice(calls)
            return formula.xreplace({call: type(call)(call.args[0] + draw.choice(names))})
        case 2 if len(terms) > 1:
            return sp.Add(*terms[:place], *terms[place + 1 :])
        case 3:
            return sp.Add(*terms[:place], 2 * terms[place], *terms[place + 1 :])
        case 4:
            name = draw.choice(names)
            return formula.xreplace({name: name**2})
        case _:
            return sp.Add(*terms[:place], -terms[place], *terms[place + 1 :])


@pytest.mark.parametrize("sheet", SHEETS)
def test_a_mistake_is_found_where_it_is_made(sheet: str) -> None:
    draw, known = random.Random(sheet), list(results(sheet))
    for asked, name, rows in draw.choices(known, k=ANSWERS):
        new = [[rewritten(draw, entry) if draw.random() < 0.5 else entry for entry in row] for row in rows]
        i, j = draw.randrange(len(rows)), draw.randrange(len(rows[0]))
        if rows[i][j].free_symbols and draw.random() < 0.6:
            new[i][j] = mistaken(draw, rows[i][j])
        wrong = not are_equal(draw, new[i][j], rows[i][j])
        hand = Hand(draw)
        matrix = isinstance(asked.derivation.results[name], Matrix)
        typed = hand.around(hand.matrix(new) if matrix else hand.write(new[0][0]))
        found = [check.verdict for check in checks(replace(asked, answer={name: typed}))]
        wanted = ["equal"] * len(found)
        wanted[i * len(rows[0]) + j] = "differs" if wrong else "equal"
        assert found == wanted, (name, typed)


# -- sets of solutions --------------------------------------------------------------------------------


def turned(draw: random.Random, angle: sp.Expr) -> sp.Expr:
    """The same angle in another form of the books, whole turns apart."""
    for call in sorted(angle.atoms(sp.atan2), key=str):
        y, x = call.args
        forms = (
            2 * sp.atan(y / (sp.sqrt(x**2 + y**2) + x)),
            sp.pi / 2 - sp.atan2(x, y),
            -sp.atan2(-y, x),
            call,
        )
        angle = angle.xreplace({call: draw.choice(forms)})
    return angle + 2 * sp.pi * draw.choice((0, 0, 1, -1))


def off(draw: random.Random, value: sp.Expr) -> sp.Expr:
    """With a sign, the arguments of an atan2, or a quadrant wrong."""
    calls = sorted(value.atoms(sp.atan2), key=str)
    if not calls or draw.random() < 0.3:
        return -value if value.free_symbols else value + 1
    call = draw.choice(calls)
    y, x = call.args
    return value.xreplace({call: draw.choice((sp.atan2(x, y), sp.atan(y / x), sp.atan2(y, -x)))})


def test_solutions_are_found_in_any_order() -> None:
    draw = random.Random(5)
    sets = [asked for asked in questions("planar-2r") if "solutions" in asked.derivation.results]
    for asked in draw.choices(sets, k=SETS):
        solutions: Any = asked.derivation.results["solutions"]
        order = draw.sample(range(len(solutions)), len(solutions))
        typed, wrong = [], draw.choice((None, *order))
        for k in order:
            values = {name: for_sympy(value) for name, value in solutions[k].values.items()}
            new = {
                name: turned(draw, value) if value.has(sp.atan2) else value for name, value in values.items()
            }
            if k == wrong:
                name = draw.choice(sorted(new))
                new[name] = off(draw, values[name])
            hand = Hand(draw)
            typed.append({name: hand.write(value) for name, value in new.items()})
        found = checks(replace(asked, answer={"solutions": typed}))[: len(order)]
        for k, check in zip(order, found, strict=True):
            assert check.verdict == ("differs" if k == wrong else "equal"), (typed, check)
