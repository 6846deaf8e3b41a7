"""One peer on one case in a process of its own: `python3 -m benchmarks.worker MODULE LETTER`.

Prints a line when everything is imported and read, one with what the derivation took, and one with
the number by which the answer is compared.
"""

from __future__ import annotations

import json
import random
import sys
from collections.abc import Iterator
from importlib import import_module
from time import perf_counter

from benchmarks.cases import Case, case
from benchmarks.peers import CannotDo, Point
from derive.expression import free_symbols
from derive.kinds.problem import expressions
from derive.mechanics.robot import Robot


def main() -> None:
    module, letter = sys.argv[1:]
    for line in run(module, case(letter)):
        print(json.dumps(line), flush=True)


def run(module: str, asked: Case) -> Iterator[dict[str, object]]:
    """ready, then seconds or why not, then value."""
    robot = asked.robot()
    try:
        peer = import_module(f"benchmarks.peers.{module}")
    except ModuleNotFoundError as missing:
        yield {"missing": missing.name}
        return
    given = peer.given(robot)
    yield {"ready": True}
    start = perf_counter()
    try:
        answer = peer.derive(given, asked.asked)
    except CannotDo as reason:
        yield {"cannot": str(reason)}
        return
    yield {"seconds": perf_counter() - start}
    yield {"value": peer.check(answer, point_of(robot))}


def point_of(robot: Robot) -> Point:
    """The same random value for every symbol in every process."""
    names = sorted({name for expr in expressions(robot) for name in free_symbols(expr)} | {"g"})
    draw = random.Random(" ".join(names))
    return {name: draw.uniform(0.2, 1.9) for name in names}


if __name__ == "__main__":
    main()
