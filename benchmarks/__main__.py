"""One command: every case by every peer, and whole commands."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import click
from rich.console import Console

from benchmarks.cases import CASES
from benchmarks.commands import time_commands
from benchmarks.peers import PEERS
from benchmarks.race import race
from benchmarks.table import Results, page, tables
from benchmarks.truths import truth_shares

LETTERS = ",".join(case.letter for case in CASES)
MODULES = ",".join(peer.module for peer in PEERS)
WIDTH = 150
PAGE = Path(__file__).parent.parent / "docs" / "benchmarks.md"


@click.command()
@click.option("--cases", default=LETTERS, show_default=True, help="Letters of cases; empty for none.")
@click.option("--peers", default=MODULES, show_default=True, help="Who takes part besides derive.")
@click.option("--rounds", default=5, show_default=True, help="Fresh processes for each figure.")
@click.option("--limit", default=20.0, show_default=True, help="Seconds that a derivation may take.")
@click.option("--commands/--no-commands", default=True, help="Time whole commands.")
@click.option("--markdown", is_flag=True, help="Write docs/benchmarks.md.")
@click.option("--note", default="", help="A sentence about the circumstances, for that page.")
def main(
    cases: str, peers: str, rounds: int, limit: float, commands: bool, markdown: bool, note: str
) -> None:
    """Derivations and whole commands as ratios to `import sympy` in the same run."""
    console = Console(width=WIDTH)  # a narrower table would cut figures off
    with console.status("") as status:
        results = _measured(cases.split(","), peers.split(","), rounds, limit, commands, status.update)
    for table in tables(results):
        console.print(table)
    if markdown:
        PAGE.parent.mkdir(exist_ok=True)
        PAGE.write_text(page(results, note), encoding="utf-8")
        console.print(str(PAGE))


def _measured(
    letters: list[str],
    modules: list[str],
    rounds: int,
    limit: float,
    commands: bool,
    say: Callable[[str], None],
) -> Results:
    chosen = tuple(peer for peer in PEERS if peer.module in ("ours", *modules))
    cells = {case: race(case, chosen, rounds, limit, say) for case in CASES if case.letter in letters}
    whole, truths = (time_commands(rounds, say), truth_shares(say)) if commands else ({}, {})
    return Results(chosen, cells, whole, rounds, limit, truths)


if __name__ == "__main__":
    main()
