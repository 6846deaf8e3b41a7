"""A slider-crank closed: the place of the slider and the angle of the rod for an angle of the crank."""

from __future__ import annotations

from derive.derivation import Phrase, Step
from derive.expression import ZERO, Expr, Symbol, add, atan2, cos, sin, sqrt, squared, subtract
from derive.kinds.mechanism._assemblies import Assembly, Closed
from derive.kinds.work import Work
from derive.mechanics.linkages import SliderCrank
from derive.names import free

THETA_3 = Symbol("theta_3")


def lengths(linkage: SliderCrank, work: Work) -> tuple[Work, dict[str, Symbol]]:
    """The board with the names of the bars, of the angle of the crank and of the offset, if there is one."""
    work, names = work.naming(l_2=linkage.crank, l_3=linkage.rod, theta_2=linkage.angle)
    found = dict(zip(("a", "b", "theta"), names, strict=True))
    if linkage.offset != ZERO:
        work, (found["e"],) = work.naming(e=linkage.offset)
    return work, found


def closed(linkage: SliderCrank, work: Work) -> Closed:
    """The slider lies on its line and on a circle about the end of the crank (Norton, Design of Machinery,
    section 4.6)."""
    work, names = lengths(linkage, work)
    a, b, theta = (names[name] for name in ("a", "b", "theta"))
    height: Expr = names.get("e", ZERO)
    s, x, y, w = (Symbol(free(work.problem.taken, name, f"{name}_p")) for name in ("s", "x", "y", "w"))
    work = work.worked(x.name, a * cos(theta)).worked(y.name, a * sin(theta))
    up: Expr = subtract(height, y)
    straight = squared(y if height == ZERO else up)
    work = work.showing(Step("apart", (add(squared(subtract(s, x)), straight), b**2), "in-numbers"))
    root = sqrt(b**2 - straight)
    work = work.line(w.name, root, value=root)
    places = {"outwards": x + w, "inwards": subtract(x, w)}
    rod = atan2(up, subtract(s, x))
    steps = [Step(side, (s, place), "in-numbers") for side, place in places.items()]
    work = work.showing(*steps, Step("theta_3", (THETA_3, rod), "in-numbers"))
    working: dict[Symbol, Expr] = {name: work[name] for name in (x, y, w)}
    assemblies = tuple(
        Assembly(Phrase(side), {**working, s: place, THETA_3: rod}, (THETA_3, s))
        for side, place in places.items()
    )
    return Closed(work, assemblies, w, s, names | {"x": x, "y": y, "w": w, "s": s})
