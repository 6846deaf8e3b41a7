"""What q holds, said among the conventions of a sheet: formulas have q, and its pages theta_1 and d_3."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field, replace

from derive.expression import Expr, Indexed, Number, Symbol, column, walk
from derive.render.document import ProblemPage
from derive.render.known_names import alone
from derive.render.latex import Printer
from derive.render.layout import Link, one_line
from derive.render.notation import Notation
from derive.render.printed import Printed
from derive.render.skin import environment

Q = re.compile(r"q(_[ijk]+)?(_?d?dot)?")  # q, its rates, and any of its entries
RATE = re.compile(r"q_?d?dot")
TYPED = re.compile(r"\(q(?:_k)?\)|(?<![A-Za-z\\])q_(?:k\b|\{k)")  # f(q), and q_k of steps
POINT = re.compile(r"q_[1-9]\d*")  # where points are called so, q is one of them; q_0 is where joints begin
WORDS = "words/_coordinates.j2"


def speaks_of_q(printed: Iterable[Printed]) -> bool:
    """Whether a formula has the vector q, or an entry of it in general."""
    formulas = [*printed]
    found = _named(formulas)
    if any(map(POINT.fullmatch, found)):
        return any(map(RATE.fullmatch, found))
    typed = (line for each in formulas if not each.chains for line in each.lines)
    return any(map(Q.fullmatch, found)) or any(map(TYPED.search, typed))


def point_by_q(printed: Iterable[Printed], variables: Iterable[str]) -> str:
    """The first of the points that are called q_1 and so on, "" where none is: joint variables may be."""
    return next((name for name in sorted(_named(printed) - {*variables}) if POINT.fullmatch(name)), "")


def _named(printed: Iterable[Printed]) -> set[str]:
    trees = (link.tree for each in printed for chain in each.chains for link in chain if link.tree)
    return {name for tree in trees for node in walk(tree) if (name := _name(node))}


def _name(node: Expr) -> str:
    match node:
        case Symbol(name):
            return name
        case Indexed(base, (Symbol(index),)):
            return f"{base}_{index}"
        case Indexed(base, (Number(index),)):
            return f"{base}_{index}"
    return ""


@dataclass(frozen=True, slots=True)
class Spoken:
    """What goes by q on a sheet: the joint variables of `arms`, each with its notation and its problems;
    another quantity in problems without joints; a point of an axis by q and an index, in these problems of
    all that were `read`. Formulas of `silent` arms do without q."""

    arms: dict[tuple[str, ...], tuple[Notation, tuple[int, ...]]] = field(default_factory=dict)
    other: bool = False
    point: str = ""
    points: tuple[int, ...] = ()
    read: frozenset[int] = frozenset()
    silent: frozenset[tuple[str, ...]] = frozenset()

    def and_by(self, problem: ProblemPage, printed: Iterable[Printed]) -> Spoken:
        """With these formulas of a question."""
        formulas, variables = [*printed], problem.variables
        point = point_by_q(formulas, variables) if variables else ""
        points = dict.fromkeys((*self.points, problem.number)) if point else self.points
        known = replace(self, point=self.point or point, points=(*points,), read=self.read | {problem.number})
        if not variables:
            return replace(known, other=self.other or "q" in _named(formulas) or speaks_of_q(formulas))
        if not speaks_of_q(formulas):
            return replace(known, silent=self.silent | {variables})
        notation, numbers = self.arms.get(variables, (problem.notation, ()))
        met = dict.fromkeys((*numbers, problem.number))
        return replace(known, arms={**self.arms, variables: (notation, (*met,))})


def coordinates(spoken: Spoken, printed: list[Printed]) -> str:
    """The sentence for the first of the arms, "" where there is none; its formula is added to `printed`."""
    if not spoken.arms:
        return ""
    variables, (notation, numbers) = next(iter(spoken.arms.items()))
    printer = Printer(notation, in_line=True)
    trees = Symbol("q"), column(map(Symbol, variables))
    chain = tuple(Link("=", printer.write(tree), tree) for tree in trees)
    printed.append(Printed.inline(one_line(chain), chain, notation))
    q = f"${one_line(chain)}$"
    words = environment().get_template(WORDS)
    point = alone(Symbol(spoken.point), notation, printed) if spoken.point else ""
    several, others = len(variables) > 1, len(spoken.arms) > 1
    alone_so = spoken.other or (not others and bool(spoken.silent - {*spoken.arms}))
    problems = numbers if alone_so else ()
    points = spoken.points if spoken.read - {*spoken.points} else ()
    return words.render(
        q=q, several=several, others=others, problems=problems, point=point, points=points
    ).strip()
