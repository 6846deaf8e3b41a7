"""The joint rates that suit best among those for a velocity: least, weighted, damped, with a second task or
within limits."""

from __future__ import annotations

from dataclasses import replace

from derive.derivation import Derivation, PageFacts, Result
from derive.expression import Expr, Matrix, Symbol
from derive.kinds.meanings import told as in_numbers
from derive.kinds.problem import Problem
from derive.kinds.spaces._redundancy.board import Board, in_functions, typed_decimals
from derive.kinds.spaces._redundancy.found import Found, Told, begun
from derive.kinds.spaces._redundancy.given import Given, Options, given
from derive.kinds.spaces._redundancy.methods import METHODS
from derive.kinds.spaces._redundancy.saturation import Limited, within_limits
from derive.kinds.values_at import Here, values_at
from derive.kinds.work import Work
from derive.mechanics.matrices import GivenMatrix
from derive.mechanics.robot import Robot

SUBJECTS = ("robot", "matrix")
USES = frozenset({"variables"})
CLAIMS = ("as-told",)
NEAR = 1e-6

__all__ = ["CLAIMS", "SUBJECTS", "USES", "Facts", "Options", "derive"]


class Facts(PageFacts):
    sort: str  # "rows", "task", "matrix"
    place: tuple[tuple[Expr, Expr], ...]
    rows: tuple[Symbol, ...]
    method: str
    told: Told
    limited: Limited | None = None


def derive(subject: Robot | GivenMatrix, options: Options, problem: Problem) -> Derivation:
    """qdot (n by 1) by pseudo-inverse, null space and priority (Siciliano et al., section 3.5; De Luca,
    Robotics 2, kinematic redundancy), within limits by Flacco, De Luca and Khatib (2012).

    Raises NotDerivable where a method needs what is not given or not so, and for formulas that fill pages.
    """
    asked = given(subject, options, problem)
    found, limited = _found(asked, options)
    board = found.board
    work = board.work
    chains = [step.chain for step in work.steps if step.chain and step.chain[0] in board.again]
    chains += board.told
    place = {**problem.where, **dict(asked.map.place)}
    work = work.claim(in_numbers(chains, board.meanings, asked.symbols, place, tolerance=NEAR))
    results: dict[str, Result] = {
        key: work[name] if key == "s" else board.results[name] for key, name in found.results.items()
    }
    facts = Facts(
        sort=asked.map.sort,
        place=tuple((Symbol(name), value) for name, value in asked.map.place),
        rows=asked.map.velocities if asked.map.sort == "rows" else (),
        method=options.method,
        told=found.told,
        limited=limited,
        page_names={key: name for key, name in found.results.items() if key != name.name},
    )
    wide = frozenset(key for key, value in results.items() if key != "qdot" and isinstance(value, Matrix))
    answer = work.answer("redundancy", results, replace(facts, numbers=()), matrices=wide)
    if options.evaluate is None:
        return answer
    here = Here.of(dict(options.evaluate), problem.where, problem.style)
    return replace(answer, evaluated=values_at(answer, here))


def _found(asked: Given, options: Options) -> tuple[Found, Limited | None]:
    """Exactly where numbers are short, else in decimals."""
    trees = [asked.map.problem.readable_matrix(asked.map.J)]
    if asked.second is not None:
        trees.append(asked.problem.readable_matrix(asked.second.J))
    decimals = asked.problem.style.decimals or typed_decimals(*asked.trees)
    exact = Board(_work(asked), decimals=decimals)
    if not any(map(in_functions, trees)) and not _irrational(asked, options):
        found = _by(asked, options, exact)
        if not found[0].board.long():
            return found
    return _by(asked, options, replace(exact, rounded=True))


def _irrational(asked: Given, options: Options) -> bool:
    """Whether limits are to be compared with roots."""
    entries = (*asked.map.J.entries, *asked.exact(asked.velocity).entries)
    return options.method == "within-limits" and any(each.constant is None for each in entries)


def _work(asked: Given) -> Work:
    bases = (*asked.map.base, *(asked.second.base if asked.second else ()))
    wanted = zip(asked.map.velocities, asked.velocity.rows, strict=True)
    valued: dict[Expr, Expr] = {
        name: value for name, (value,) in wanted if asked.options.velocity is None and name != value
    }
    work = Work(asked.problem, uses=tuple({id(each): each for each in bases}.values()))
    return work.knowing(valued)


def _by(asked: Given, options: Options, board: Board) -> tuple[Found, Limited | None]:
    board = begun(asked, board)
    if options.method == "within-limits":
        return within_limits(asked, board)
    return METHODS[options.method](asked, board), None
