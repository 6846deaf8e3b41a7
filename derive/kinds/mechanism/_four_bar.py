"""A four-bar linkage closed: the angles of its coupler and its rocker for an angle of the crank."""

from __future__ import annotations

from derive.derivation import Phrase, Step
from derive.expression import Expr, Symbol, add, atan2, cos, sin, sqrt, squared, subtract
from derive.kinds.mechanism._assemblies import Assembly, Closed
from derive.kinds.work import Work
from derive.mechanics.linkages import FourBar
from derive.names import free

THETA_3, THETA_4 = Symbol("theta_3"), Symbol("theta_4")


def lengths(linkage: FourBar, work: Work) -> tuple[Work, dict[str, Symbol]]:
    """The board with the names of the bars and of the angle of the crank; the bars have the numbers of their
    angles, the ground is the first."""
    work, names = work.naming(
        l_2=linkage.crank, l_3=linkage.coupler, l_4=linkage.rocker, l_1=linkage.ground, theta_2=linkage.angle
    )
    return work, dict(zip(("a", "b", "c", "d", "theta"), names, strict=True))


def closed(linkage: FourBar, work: Work) -> Closed:
    """The tip of the rocker lies on two circles, about its pivot and about the end of the crank (Norton,
    Design of Machinery, section 4.5; the quadrangle of Siciliano et al., section 2.9.2)."""
    work, names = lengths(linkage, work)
    a, b, c, d, theta = names.values()
    x, y, E, k, w = (
        Symbol(free(work.problem.taken, name, f"{name}_p")) for name in ("x", "y", "E", "k", "w")
    )
    work = work.worked(x.name, subtract(a * cos(theta), d)).worked(y.name, a * sin(theta))
    work = work.worked(E.name, x**2 + y**2)
    tip = (c * cos(THETA_4), c * sin(THETA_4))
    apart = (add(squared(subtract(tip[0], x)), squared(subtract(tip[1], y))), b**2)
    work = work.showing(Step("apart", apart, "in-numbers"))
    work = work.showing(Step("along", (x * cos(THETA_4) + y * sin(THETA_4), k), "in-numbers"))
    work = work.worked(k.name, (E + c**2 - b**2) / (2 * c))
    work = work.line(w.name, sqrt(E - k**2), value=sqrt(E - k**2))
    rockers = {
        "left": atan2(y * k + x * w, x * k - y * w),
        "right": atan2(y * k - x * w, x * k + y * w),
    }
    coupler = atan2(subtract(tip[1], y), subtract(tip[0], x))
    steps = [Step(side, (THETA_4, rocker), "in-numbers") for side, rocker in rockers.items()]
    work = work.showing(*steps, Step("theta_3", (THETA_3, coupler), "in-numbers"))
    working: dict[Symbol, Expr] = {name: work[name] for name in (x, y, E, k, w)}
    assemblies = tuple(
        Assembly(Phrase(side), {**working, THETA_4: rocker, THETA_3: coupler}, (THETA_3, THETA_4))
        for side, rocker in rockers.items()
    )
    names |= {"x": x, "y": y, "E": E, "k": k, "w": w}
    return Closed(work, assemblies, w, w, names)
