"""What the answers about an arm measure, in SI units: by the joints, where these turn and slide."""

from __future__ import annotations

from collections.abc import Callable

from derive.mechanics.robot import Link, Robot

Units = dict[str, str]


def of_joints(*names: str, power: int = 0, effort: bool = False) -> Callable[[Robot], Units]:
    """Vectors with an entry a joint: a variable differentiated so often, or what drives it. They have a unit
    where all joints turn, or all of them slide."""

    def measures(robot: Robot) -> Units:
        found = {_effort(link) if effort else _rate(link, power) for link in robot.links if link.variable}
        unit = found.pop() if len(found) == 1 else ""
        return {**of_variables(robot), **dict.fromkeys(names, unit)}

    return measures


def of_variables(robot: Robot) -> Units:
    """The joint variables, their rates and accelerations, what drives the joints, and origins of frames."""
    units: Units = {f"o_{number}": "m" for number in range(len(robot.links) + 1)}
    for number, link in enumerate((link for link in robot.links if link.variable), 1):
        for power, suffix in enumerate(("", "_dot", "_ddot")):
            units[f"{link.variable}{suffix}"] = _rate(link, power)
        units[f"tau_{number}"] = _effort(link)
    return units


def of_energies(*letters: str) -> Callable[[Robot], Units]:
    """Energies of each link and of the whole arm."""

    def measures(robot: Robot) -> Units:
        numbers = ("", *(f"_{number}" for number in range(1, len(robot.links) + 1)), "_m")
        return {f"{letter}{number}": "J" for letter in letters for number in numbers}

    return measures


def together(*each: Callable[[Robot], Units], **fixed: str) -> Callable[[Robot], Units]:
    """The units of several results; `fixed` are those that depend on no joint."""

    def measures(robot: Robot) -> Units:
        return {name: unit for units in each for name, unit in units(robot).items()} | fixed

    return measures


def _rate(link: Link, power: int) -> str:
    base = "m" if link.joint == "prismatic" else "rad"
    return base + ("", "/s", "/s^2")[power]


def _effort(link: Link) -> str:
    return "N" if link.joint == "prismatic" else "N m"
