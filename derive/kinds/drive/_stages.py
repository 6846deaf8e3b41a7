"""The ratio of each stage of a transmission, by the names of its sizes."""

from __future__ import annotations

from collections import Counter

from derive.derivation import Phrase
from derive.expression import ONE, Expr, Quotient, Symbol, negate
from derive.kinds.problem import Problem
from derive.kinds.work import Work
from derive.mechanics.gearing import Stage
from derive.names import named

LETTERS = {"teeth": "z", "radii": "r", "diameters": "d"}
OWN = {"harmonic": ("z_f", "z_c"), "planetary": ("z_s", "z_r")}  # of the parts of one, whatever its place


def ratio(stage: Stage, sizes: tuple[Expr, ...]) -> Expr:
    """How often what drives turns while what it drives turns once, negative where that turns backwards."""
    if stage.form == "ratio":
        return sizes[0]
    first, second = sizes
    match stage.form:
        case "gears" | "crossed":
            return negate(Quotient(second, first))
        case "harmonic":
            return negate(Quotient(first, second - first))
        case "planetary":
            return ONE + Quotient(second, first)
    return Quotient(second, first)


def with_sizes(
    work: Work, stages: tuple[Stage, ...], problem: Problem, whole: Symbol
) -> tuple[Work, list[tuple[Symbol, ...]]]:
    """The names of the sizes, stage by stage, as the author has them or numbered through by their letters:
    z_1 drives z_2, r_1 drives r_2; a ratio is that of its stage."""
    used, found, pairs = set(problem.taken), list[tuple[Symbol, ...]](), Counter[str]()
    for index, stage in enumerate(stages, 1):
        pairs[stage.measured] += stage.form not in OWN
        usual = _usual(stage, index, whole, pairs[stage.measured])
        twice = used & {*usual} and stage.form in OWN
        usual = tuple(f"{name}{index}" for name in usual) if twice else usual
        names = tuple(named(name, size, used) for name, size in zip(usual, stage.sizes, strict=True))
        used |= {name.name for name in names}
        work = work.knowing(dict[Expr, Expr](zip(names, stage.sizes, strict=True)))
        found.append(names)
    return work, found


def _usual(stage: Stage, index: int, whole: Symbol, pair: int) -> tuple[str, ...]:
    if stage.form == "ratio":
        return (f"{whole.name}_{index}",)
    letter = LETTERS[stage.measured or "teeth"]
    return OWN.get(stage.form, (f"{letter}_{2 * pair - 1}", f"{letter}_{2 * pair}"))


def described(stage: Stage, sizes: tuple[Symbol, ...]) -> Phrase:
    """What a stage is made of."""
    if len(sizes) == 1:
        return Phrase(stage.form, {"ratio": sizes[0]})
    first, second = (Phrase(stage.measured, {"size": size}) for size in sizes)
    return Phrase(stage.form, {"first": first, "second": second})
