"""The motion along a path: velocity and acceleration by the chain rule, and everything by the time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import chain
from typing import Any

from derive.algebra.formulas.with_units import measured
from derive.derivation import Phrase, Record, Result, Step
from derive.errors import NotDerivable
from derive.expression import Expr, Relation, Symbol, free_symbols
from derive.kinds.chain_rule import chain_rule
from derive.kinds.checks import route
from derive.kinds.fields import TREES
from derive.kinds.path._frenet import Bent
from derive.kinds.path._timing import T_1, T_2, T, Timed, in_time, timed
from derive.kinds.path._timing_checks import agrees
from derive.kinds.work import Work
from derive.mechanics.paths import Timing

Laws = tuple[tuple[Step, ...], ...]


class PieceTold(Record):
    """What is done in a piece of time, and when; its steps."""

    said: Phrase | None  # None of the only one
    lines: tuple[str, ...]


class Motion(Record):
    """How the parameter goes in time."""

    said: Phrase
    test: Phrase | None  # whether there is time at the greatest velocity
    given: tuple[tuple[Expr, Expr], ...]
    sizes: tuple[str, ...]  # steps
    pieces: tuple[PieceTold, ...]
    rates: tuple[str, ...]  # steps of the velocity and the acceleration


@dataclass(frozen=True, slots=True)
class Moved:
    """The board with the laws of time, in pieces, and the rates of the place."""

    work: Work
    found: Bent
    time: Timed
    laws: Laws
    rates: tuple[Symbol, Symbol]
    on_page: Mapping[str, str | Expr]

    def finished(self, by_parameter: Mapping[str, Result]) -> tuple[Work, dict[str, Result], Motion]:
        """With the claims about all of it, the results by the time, and what the words say."""
        work, time, s = self.work, self.time, self.time.names[0]
        results: dict[str, Result] = {
            key: in_time(tree, time) if isinstance(tree, TREES) else tree
            for key, tree in by_parameter.items()
        }
        results |= {s.name: in_time(s, time), "time": work.final(time.time)}
        printed = [
            (Symbol(str(self.on_page.get(key, key))), tree)
            for key, tree in results.items()
            if isinstance(tree, TREES)
        ]
        names = {*time.lines, *(rate.name for rate in self.rates)}
        lines = [step.chain for step in work.steps if step.name in names]
        motion = self._told()

        def chains(k: int) -> list[Any]:
            return [*(step.chain for step in self.laws[k]), *lines, *motion.given, *printed]

        held = agrees(work.problem, self.found, replace(time, work=work), chains)
        work = work.claim(route("timed", held))
        return work.law("said-in-time", _said(motion, time, self.found)), results, motion

    def _told(self) -> Motion:
        given = ((name, self.work[name]) for name in self.time.given.values())
        return Motion(
            said=_law_told(self.time, self.found),
            test=_test_told(self.time),
            given=tuple((name, measured(value)) for name, value in given if value != name),
            sizes=self.time.lines,
            pieces=tuple(
                PieceTold(said=_when(self.time, k), lines=tuple(step.name for step in laws))
                for k, laws in enumerate(self.laws)
            ),
            rates=(self.rates[0].name, self.rates[1].name),
        )


def in_motion(work: Work, found: Bent, timing: Timing, page_names: Mapping[str, str | Expr]) -> Moved:
    """The laws of time, then dp/dt = dp/ds ds/dt and its derivative (Siciliano et al., eqs. 4.36 and 4.37).

    Raises NotDerivable where the sheet has another t, or sizes that make no motion.
    """
    p = found.along.p
    if T.name in work.problem.taken:
        raise NotDerivable("the time is called t here, and the sheet has another t")
    time = timed(timing, found, work)
    _, s_dot, s_ddot = time.names
    p_dot, p_ddot = Symbol(f"{p.name}_dot"), Symbol(f"{p.name}_ddot")
    laws = tuple(
        tuple(
            Step(f"law_{k}_{order}", (name, law), "in-numbers")
            for order, (name, law) in enumerate(zip(time.names, piece.laws, strict=True))
        )
        for k, piece in enumerate(time.pieces)
    )
    velocity = found.first * s_dot
    acceleration = found.first * s_ddot + found.second * s_dot**2
    work = time.work.showing(*chain(*laws)).line(p_dot, velocity).line(p_ddot, acceleration)
    rule = chain_rule((velocity, acceleration), (found.first, found.second), time.names)
    work = work.claim(route("timed", rule))
    on_page = {**page_names, "v": p_dot.name, "a": p_ddot.name, "time": time.time.name}
    return Moved(work, found, time, laws, (p_dot, p_ddot), on_page)


def _law_told(time: Timed, found: Bent) -> Phrase:
    about: dict[str, Any] = {"s": time.names[0], "T": time.time}
    if time.law != "trapezoidal":
        return Phrase("by-cubic" if time.law == "cubic" else "by-quintic", about)
    about |= {"risen": T_1, "falling": T_2}
    if not found.work.problem.subject.along:
        return Phrase("by-trapezoid-of-s" if time.reached else "by-triangle-of-s", about)
    return Phrase("by-trapezoid" if time.reached else "by-triangle", about)


def _test_told(time: Timed) -> Phrase | None:
    """What both ramps cover beside the way."""
    if time.ramps is None:
        return None
    value = time.work.readable(time.work.scalar(time.ramps))
    ramps = time.ramps if free_symbols(value) else Relation(time.ramps, "=", value)
    return Phrase("ramps-fit" if time.reached else "ramps-too-long", {"ramps": ramps, "way": time.way})


def _when(time: Timed, k: int) -> Phrase | None:
    """What is done in a piece of time."""
    when = {"when": time.pieces[k].when}
    if len(time.pieces) == 1:
        return None
    return Phrase(
        "speeds-up" if k == 0 else "slows-down" if k == len(time.pieces) - 1 else "goes-evenly", when
    )


def _said(motion: Motion, time: Timed, found: Bent) -> Iterator[bool]:
    """Whether each piece is what it is called, by the change of the velocity."""
    changes = [piece.laws[2] for piece in time.pieces]
    yield len(motion.pieces) == len(changes) == {"cubic": 1, "quintic": 1}.get(time.law, 2 + time.reached)
    for told_as, piece, change in zip(motion.pieces, time.pieces, changes, strict=True):
        if told_as.said is None:
            yield len(changes) == 1
        else:
            keys = {1: "speeds-up", -1: "slows-down", 0: "goes-evenly", None: told_as.said.key}
            yield told_as.said.key == keys[time.work.sign(change)]
            yield told_as.said.about["when"] == piece.when
    if motion.test is not None and time.ramps is not None:
        fits = time.work.sign(time.way - time.ramps) == 1
        yield motion.test.key == ("ramps-fit" if fits else "ramps-too-long")
    yield motion.said.key.endswith("-of-s") == (
        time.law == "trapezoidal" and not found.work.problem.subject.along
    )
