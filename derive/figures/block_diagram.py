"""The block diagram of a system as a teacher draws it, in a loop with a controller where there is one."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from derive.algebra.readable.form import readable
from derive.algebra.readable.terms import Style
from derive.control.controllers import GAINS, Controller
from derive.control.diagram import Block, Diagram, Line, integrator, source, summing, transfer
from derive.control.rational import Polynomial, Rational
from derive.control.realisation import Branch, Realised, realisations
from derive.control.system import System
from derive.errors import NotDerivable
from derive.expression import ONE, ZERO, Expr, Symbol, is_negative, negate
from derive.names import free


@dataclass(frozen=True, slots=True)
class Wired:
    """How a signal is computed in a diagram: `starts` are the blocks its branches begin at, `stages` the
    blocks of the signal and of its derivatives, by order."""

    realised: Realised
    starts: tuple[str, ...]
    stages: tuple[str, ...]


def drawn(
    system: System, whole: Rational, controller: Controller | None, style: Style
) -> tuple[Diagram, tuple[Wired, ...]]:
    """The diagram and how each signal is computed; one block for `whole` (output over input) and no
    signals where the equations, one by one, cannot be built.

    Raises NotDerivable where that block would differentiate, or its loop has no delay.
    """
    for found in realisations(system, style):
        drawing = _Drawing(system, controller, style)
        diagram = drawing.diagram(found)
        if not diagram.looped:
            return diagram, tuple(drawing.wired)
    if not whole.proper:
        raise NotDerivable("the transfer function is improper: no diagram of blocks can be simulated")
    diagram = _Drawing(system, controller, style).alone(whole)
    if diagram.looped:
        raise NotDerivable("the loop is an algebraic one: its blocks answer at once, without any delay")
    return diagram, ()


def gain_names(controller: Controller, taken: frozenset[str]) -> tuple[Symbol, ...]:
    """A name for each gain; its own where it is one already."""
    names = []
    for letter, gain in zip(controller.family, controller.gains, strict=True):
        name = GAINS[letter]
        clash = name in taken and gain != Symbol(name)
        names.append(Symbol(f"{name}_c" if clash else name))
    return tuple(names)


def filter_name(system: System) -> Symbol:
    """The time constant of the filter behind an ideal derivative; a T of its own where T has an index."""
    usual = "tau_f" if any(name.startswith("T_") for name in system.names) else "T_f"
    return Symbol(free(system.names, usual, "T_filter"))


class _Drawing:
    """One diagram being drawn."""

    def __init__(self, system: System, controller: Controller | None, style: Style) -> None:
        self.system, self.controller, self.style = system, controller, style
        self.blocks: list[Block] = []
        self.lines: list[Line] = []
        self.wired: list[Wired] = []
        self.taken = set(system.names)

    def diagram(self, found: Sequence[Realised]) -> Diagram:
        start = self.start()
        computed = {each.signal: each for each in found}
        names = {each.signal: self.stages(each) for each in found}
        disturbance = self.system.disturbance
        if disturbance and any(b.signal == disturbance for each in found for b in each.branches):
            self.blocks.append(source(disturbance.name))
        for each in found:
            self.draw(each, names, computed)
        return self.finished(start)

    def alone(self, whole: Rational) -> Diagram:
        """One block between input and output."""
        start = self.start()
        output = self.system.output.name
        self.add(transfer(output, self.written(whole.num), self.written(whole.den)), [self.system.input.name])
        return self.finished(start)

    # -- the controller ---------------------------------------------------------------------------

    def start(self) -> str:
        """The source, and the controller where there is one; the name of the source."""
        entry = self.system.input.name
        if self.controller is None:
            self.blocks.append(source(entry))
            return entry
        reference, error = self.fresh("r"), self.fresh("e")
        self.blocks.append(source(reference))
        self.add(summing(error, (1, -1)), [reference, self.system.output.name])
        names = gain_names(self.controller, frozenset(self.system.names))
        parts = [self.part(letter, gain) for letter, gain in zip(self.controller.family, names, strict=True)]
        if len(parts) == 1:
            self.add(transfer(entry, parts[0][0], parts[0][1]), [error])
            return reference
        outputs = [self.fresh(f"u_{letter}") for letter in self.controller.family]
        for name, (num, den) in zip(outputs, parts, strict=True):
            self.add(transfer(name, num, den), [error])
        self.add(summing(entry, (1,) * len(parts)), outputs)
        return reference

    def part(self, letter: str, gain: Expr) -> tuple[tuple[Expr, ...], tuple[Expr, ...]]:
        match letter:
            case "I":
                return (gain,), (ONE, ZERO)
            case "D":
                return (gain, ZERO), (filter_name(self.system), ONE)
            case _:
                return (gain,), (ONE,)

    # -- the system -------------------------------------------------------------------------------

    def stages(self, each: Realised) -> tuple[str, ...]:
        """The signal and its derivatives that come out of a block, by order."""
        orders = each.integrators + (1 if self.has_head(each) else 0)
        return tuple(self.derivative(each.signal.name, order) for order in range(orders))

    def has_head(self, each: Realised) -> bool:
        """Whether anything stands before the integrators."""
        plain = len(each.branches) == 1 and self.written(each.branches[0].num) == (ONE,)
        return not plain or self.written(each.den) != (ONE,) or not each.integrators

    def derivative(self, name: str, order: int) -> str:
        if order == 0:
            return name
        return self.fresh(f"{name}_{'d' * (order - 1)}dot" if order < 3 else f"{name}_{order}")

    def tapped(
        self, branch: Branch, names: Mapping[Symbol, tuple[str, ...]], computed: Mapping[Symbol, Realised]
    ) -> str:
        """The block a branch starts at."""
        if branch.signal not in names:
            return branch.signal.name
        if branch.tap < len(names[branch.signal]):
            return names[branch.signal][branch.tap]
        return self.tapped(computed[branch.signal].branches[0], names, computed)

    def draw(
        self, each: Realised, names: Mapping[Symbol, tuple[str, ...]], computed: Mapping[Symbol, Realised]
    ) -> None:
        starts = [self.tapped(branch, names, computed) for branch in each.branches]
        self.wired.append(Wired(each, tuple(starts), names[each.signal]))
        *integrated, head = names[each.signal] if self.has_head(each) else (*names[each.signal], starts[0])
        if self.has_head(each):
            self.head(each, head, starts)
        chain = [head, *reversed(integrated)]
        for before, name in pairwise(chain):
            self.add(integrator(name), [before])

    def head(self, each: Realised, name: str, starts: Sequence[str]) -> None:
        """The blocks before the integrators."""
        nums, den = [self.written(branch.num) for branch in each.branches], self.written(each.den)
        if len(nums) == 1:
            self.add(transfer(name, nums[0], den), starts)
            return
        together = all(len(num) == 1 for num in nums)
        signed = [(-1, tuple(map(negate, num))) if is_negative(num[0]) else (1, num) for num in nums]
        below = (ONE,) if together else den
        ends = [self.scaled(name, start, num, below) for start, (_, num) in zip(starts, signed, strict=True)]
        order = sorted(range(len(ends)), key=lambda k: -signed[k][0])
        signs, inputs = [signed[k][0] for k in order], [ends[k] for k in order]
        if not together or den == (ONE,):
            self.add(summing(name, signs), inputs)
            return
        adder = self.fresh(f"sum_{name}")
        self.add(summing(adder, signs), inputs)
        self.add(transfer(name, (ONE,), den), [adder])

    def scaled(self, name: str, start: str, num: tuple[Expr, ...], den: tuple[Expr, ...]) -> str:
        """A branch up to the sum; the line itself where it is worth one."""
        if (num, den) == ((ONE,), (ONE,)):
            return start
        between = self.fresh(f"{start}_to_{name}")
        self.add(transfer(between, num, den), [start])
        return between

    # -- the page ---------------------------------------------------------------------------------

    def written(self, coefficients: Polynomial) -> tuple[Expr, ...]:
        return tuple(readable(c, self.style) if c else ZERO for c in coefficients) or (ZERO,)

    def add(self, block: Block, inputs: Sequence[str]) -> None:
        self.blocks.append(block)
        self.lines += [Line(each, block.name, port) for port, each in enumerate(inputs, 1)]

    def fresh(self, name: str) -> str:
        found = free(self.taken, *(name + "_" * k for k in range(len(self.taken) + 1)))
        self.taken.add(found)
        return found

    def finished(self, start: str) -> Diagram:
        return Diagram(tuple(self.blocks), tuple(self.lines), start, self.system.output.name)
