"""A block diagram as a value: blocks, each with one output, and the lines between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias

from derive.control.oracle.equations import value
from derive.expression import ONE, ZERO, Expr

Shape: TypeAlias = Literal["source", "sum", "gain", "transfer", "integrator"]


@dataclass(frozen=True, slots=True)
class Block:
    """One block; its output is a signal of its own name.

    `num` and `den` hold the coefficients of its transfer function, highest power of s first; a sum adds its
    inputs with `signs` (1 or -1), one for each port; a source has no input.
    """

    name: str
    shape: Shape
    num: tuple[Expr, ...] = (ONE,)
    den: tuple[Expr, ...] = (ONE,)
    signs: tuple[int, ...] = (1,)

    @property
    def direct(self) -> bool:
        """Whether its output follows its input at once."""
        return self.shape != "source" and len(self.num) >= len(self.den)


@dataclass(frozen=True, slots=True)
class Line:
    """From the output of one block to an input of another; ports count from 1."""

    source: str
    target: str
    port: int = 1


@dataclass(frozen=True, slots=True)
class Diagram:
    """Blocks and lines; `input` is the source that steps, `output` the block that is looked at. Other
    sources are disturbances."""

    blocks: tuple[Block, ...]
    lines: tuple[Line, ...]
    input: str
    output: str

    def block(self, name: str) -> Block:
        """Raises StopIteration where there is none."""
        return next(block for block in self.blocks if block.name == name)

    def into(self, block: Block) -> tuple[str, ...]:
        """What enters a block, in the order of its ports."""
        found = sorted((line.port, line.source) for line in self.lines if line.target == block.name)
        return tuple(source for _, source in found)

    def targets(self, name: str) -> tuple[str, ...]:
        """What a block feeds."""
        return tuple(line.target for line in self.lines if line.source == name)

    @property
    def disturbances(self) -> tuple[str, ...]:
        """The names of the sources that do not step."""
        return tuple(b.name for b in self.blocks if b.shape == "source" and b.name != self.input)

    @property
    def looped(self) -> bool:
        """Whether blocks without delay form a circle, an algebraic loop."""
        waiting = {block.name: set(self.into(block)) for block in self.blocks if block.direct}
        while free := [name for name, before in waiting.items() if not before & waiting.keys()]:
            for name in free:
                del waiting[name]
        return bool(waiting)

    def gain(self, s: complex, point: Mapping[str, complex]) -> complex:
        """output / input at one s, read off the blocks and lines alone; disturbances are zero.

        Raises KeyError for a name without a value.
        """
        import numpy

        places = {block.name: place for place, block in enumerate(self.blocks)}
        matrix = numpy.eye(len(self.blocks), dtype=complex)
        for block in self.blocks:
            through = _at(block, s, point)
            for sign, source in zip(block.signs, self.into(block), strict=False):
                matrix[places[block.name], places[source]] -= sign * through
        drive = numpy.zeros(len(self.blocks), dtype=complex)
        drive[places[self.input]] = 1.0
        return complex(numpy.linalg.solve(matrix, drive)[places[self.output]])


def source(name: str) -> Block:
    """A block without an input."""
    return Block(name, "source")


def summing(name: str, signs: Sequence[int]) -> Block:
    """A sum with a sign, 1 or -1, for each of its inputs."""
    return Block(name, "sum", signs=tuple(signs))


def integrator(name: str) -> Block:
    """The block 1/s."""
    return Block(name, "integrator", (ONE,), (ONE, ZERO))


def transfer(name: str, num: Sequence[Expr], den: Sequence[Expr]) -> Block:
    """The block for num/den: a gain, an integrator or a transfer function."""
    top, bottom = tuple(num), tuple(den)
    if bottom == (ONE,) and len(top) == 1:
        return Block(name, "gain", top)
    if (top, bottom) == ((ONE,), (ONE, ZERO)):
        return integrator(name)
    return Block(name, "transfer", top, bottom)


def _at(block: Block, s: complex, point: Mapping[str, complex]) -> complex:
    if block.shape in ("source", "sum"):
        return 1 + 0j
    num = [value(c, point) for c in block.num]
    den = [value(c, point) for c in block.den]
    return _horner(num, s) / _horner(den, s)


def _horner(coefficients: Sequence[complex], s: complex) -> complex:
    total = 0j
    for coefficient in coefficients:
        total = total * s + coefficient
    return total
