"""The sheet that kinds of a robot show as their example."""

from __future__ import annotations

SHEET = """\
title: {title}
problems:
- robot:
    links:
    - {{theta: theta1*, d: 0, a: {a}1, alpha: 0}}
    - {{theta: theta2*, d: 0, a: {a}2, alpha: 0}}
  {asked}
"""


def two_links(title: str, *asked: str, a: str = "a") -> str:
    """A sheet (YAML) about an arm of two links in a plane, of lengths a1 and a2, with the lines of what is
    asked about it."""
    return SHEET.format(title=title, asked="\n  ".join(asked), a=a)
