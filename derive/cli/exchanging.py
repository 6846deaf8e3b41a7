"""Robots of other programs: `derive import`, `derive export`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from derive.messages import guarded, page, warn


def _packages(ctx: click.Context, option: click.Parameter, value: tuple[str, ...]) -> dict[str, Path]:
    """ROS packages and their folders."""
    found = {}
    for pair in value:
        name, sign, folder = pair.partition("=")
        if not sign or not os.path.isdir(folder):
            raise click.BadParameter(f"'{pair}' is not NAME=DIR with a directory that is there")
        found[name] = Path(folder)
    return found


@click.command("import")
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--base", default="", metavar="LINK", help="Where the arm begins; else the root.")
@click.option("--tip", default="", metavar="LINK", help="Where it ends; else after the most joints.")
@click.option(
    "--within",
    default=1e-9,
    type=click.FloatRange(0, 1e-2),
    show_default=True,
    help="Angles (rad) this near to a simple one are that one.",
)
@click.option(
    "--package",
    "packages",
    multiple=True,
    callback=_packages,
    metavar="NAME=DIR",
    help="Where a ROS package is.",
)
def import_(file: Path, base: str, tip: str, within: float, packages: dict[str, Path]) -> None:
    """Print a robot of URDF or xacro, or a table of CSV, as YAML."""
    from derive.sheet.exchange.files import Wish, as_yaml
    from derive.sheet.exchange.library import Library

    with guarded():
        text, strange = as_yaml(file, Wish(base, tip, within, Library(packages)))
        for each in strange:
            warn(each)
        page(text)


def _values(ctx: click.Context, option: click.Parameter, value: tuple[str, ...]) -> dict[str, float]:
    """Names and their values, units included, in SI units."""
    from derive.algebra.formulas.grammar import parse
    from derive.algebra.numbers.floats import number

    found = {}
    for pair in value:
        name, _, typed = pair.partition("=")
        try:
            found[name.strip()] = number(parse(typed, dimension="any"), {})
        except (ValueError, KeyError, ArithmeticError) as error:
            raise click.BadParameter(f"'{pair}' is not NAME=VALUE: {error}") from error
    return found


@click.command()
@click.argument("robot", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option("--to", "form", type=click.Choice(["urdf"]), required=True)
@click.option("--value", "values", multiple=True, callback=_values, metavar="NAME=VALUE", help="Of a symbol.")
def export(robot: Path, form: str, values: dict[str, float]) -> None:
    """Print a robot's file as URDF."""
    from derive.sheet.exchange.files import as_urdf

    with guarded():
        text, strange = as_urdf(robot, values)
        for each in strange:
            warn(each)
        page(text)
