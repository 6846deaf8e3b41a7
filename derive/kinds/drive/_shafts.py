"""A drive by its gear or by the train of its stages, and the shafts in between that have an inertia too."""

from __future__ import annotations

from dataclasses import dataclass

from derive.expression import ONE, Expr, Number, Product, Symbol, number
from derive.kinds.drive._train_checks import TrainFacts
from derive.kinds.work import Work
from derive.mechanics.sensing import Drive


@dataclass(frozen=True, slots=True)
class Shaft:
    """The shaft behind a stage turns `turns` times while the load turns once, and the motor `behind` times
    while the shaft turns once."""

    stage: Number
    inertia: Expr
    speed: Symbol
    turns: Expr
    behind: Expr

    def at_speed(self, load: Symbol) -> tuple[Expr, Expr]:
        """Its speed, and the same by that of the load."""
        return self.speed, load if self.turns == ONE else self.turns * load

    @property
    def at_load(self) -> Expr:
        """Its inertia as the load feels it."""
        return self.inertia if self.turns == ONE else self.turns**2 * self.inertia

    @property
    def at_motor(self) -> Expr:
        """Its inertia as the motor feels it."""
        return self.inertia / self.behind**2


def geared(work: Work, drive: Drive) -> tuple[Work, Symbol, list[Expr]]:
    """The name of the whole ratio, and the ratios of the stages."""
    if not drive.stages:
        work, (G,) = work.naming(G=drive.gear or ONE)
        return work, G, []
    train = work.problem.ask("gear-train")
    told = train.told(TrainFacts)
    ratios = [Symbol(line) if line else said.about.get("ratio", told.G) for _, said, line in told.stages]
    return work.resting_on(train), told.G, [each for each in ratios if isinstance(each, Symbol)]


def shafts_between(work: Work, drive: Drive, G: Symbol, ratios: list[Expr]) -> tuple[Work, list[Shaft]]:
    """Those behind stages that are said to have an inertia."""
    found = list[Shaft]()
    for k, stage in enumerate(drive.stages, 1):
        if stage.inertia is not None:
            work, (inertia,) = work.naming(**{f"J_{k}": stage.inertia})
            behind = _together(ratios[:k]) if ratios[k:] else G
            found.append(Shaft(number(k), inertia, Symbol(f"omega_{k}"), _together(ratios[k:]), behind))
    return work, found


def _together(ratios: list[Expr]) -> Expr:
    return Product(tuple(ratios)) if len(ratios) > 1 else ratios[0] if ratios else ONE


def typed_here(work: Work) -> tuple[tuple[Expr, Expr], ...]:
    """What is given beside that which a derivation before told."""
    before = {name for used in work.uses for name in used.definitions}
    return tuple(pair for pair in work.typed if pair[0] not in before)
