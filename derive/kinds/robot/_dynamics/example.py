"""The arm of the examples: a planar one of two links."""

from __future__ import annotations

ROD = "mass: m#, com: [-a#/2, 0, 0], inertia: {rod: a#, axis: x}"
POINT = "mass: m#, com: [0, 0, 0], inertia: point"


def planar_arm(
    title: str, find: str, body: str = ROD, length: str = "a#", gravity: bool = True, also: str = ""
) -> str:
    """A sheet that asks for one kind; # stands for the number of a link in its `body` and its `length`, and
    `also` are lines of further options."""
    row = f"    - {{theta: theta#*, d: 0, a: {length}, alpha: 0, {body}}}\n"
    pull = "    gravity: [0, -g, 0]\n" if gravity else ""
    rows = "".join(row.replace("#", number) for number in "12")
    return f"title: {title}\nproblems:\n- robot:\n{pull}    links:\n{rows}  find: {find}\n{also}"
