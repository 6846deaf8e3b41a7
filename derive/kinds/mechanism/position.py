"""The position of a four-bar linkage, a slider-crank or a five-bar linkage, each way to assemble it."""

from __future__ import annotations

from derive.derivation import Derivation
from derive.kinds.checks import route
from derive.kinds.fields import NoOptions as Options
from derive.kinds.mechanism import _four_bar, _slider_crank
from derive.kinds.mechanism._facts import PositionFacts as Facts
from derive.kinds.mechanism._five_bar import meeting
from derive.kinds.mechanism._loop import units_of
from derive.kinds.mechanism._position_checks import closes, every_way, places
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.linkages import FiveBar, FourBar, SliderCrank

NEEDS = ("loop",)
CLAIMS = ("closes",)
CLAIMED = {"solutions": "closes"}


def derive(linkage: FourBar | SliderCrank | FiveBar, options: Options, problem: Problem) -> Derivation:
    """Two circles, or a circle and a line, meet in two points (Norton, Design of Machinery, chapter 4).

    Raises NotDerivable where bars of these lengths cannot be joined.
    """
    if isinstance(linkage, FiveBar):
        return meeting(linkage, problem)
    recipe = _four_bar.closed(linkage, Work(problem)) if isinstance(linkage, FourBar) else (
        _slider_crank.closed(linkage, Work(problem))
    )  # fmt: skip
    work, names = recipe.work, recipe.names
    given = work.typed
    branches = tuple(each.branch(problem, dict(given)) for each in recipe.assemblies)
    there = places(linkage, recipe)
    work = work.claim(route("closes", closes(linkage, recipe, branches, there)))
    work = work.claim(route("every-way", every_way(linkage, recipe, there)))
    four = isinstance(linkage, FourBar)
    first, second = (each.side for each in recipe.assemblies)
    facts = Facts(
        given=given, end=(names["x"], names["y"]), rod=names["b"],
        rocker=(names["c"], names["d"]) if four else None, offset=names.get("e"),
        lines=tuple(names[name].name for name in ("E", "k", "w") if name in names),
        unknown=recipe.assemblies[0].unknown, sides=(first, second), angle_results=("theta_3", "theta_4"),
    )  # fmt: skip
    return work.answer("position", {"solutions": branches}, facts, units=units_of(problem, recipe.s))


def measures(linkage: FourBar | SliderCrank | FiveBar) -> dict[str, str]:
    """Of what is sought: the place of a slider, a point."""
    if isinstance(linkage, FiveBar):
        return {"x": "m", "y": "m"}
    return {"s": "m"} if isinstance(linkage, SliderCrank) else {}
