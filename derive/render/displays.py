"""Displayed equations of a derivation that is being told."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from derive.derivation import Step
from derive.expression import (
    Expr,
    Relation,
)
from derive.render.chain_links import chain_links, signed_links
from derive.render.entries import NAMED_BEYOND, with_named_entries
from derive.render.facts import parts
from derive.render.latex import Printer
from derive.render.layout import FRAMED, LINE, NUMBERED, Display, lay_out
from derive.render.printed import Naming, Printed, links_of
from derive.render.so_far import Equation
from derive.render.told_so_far import Shown, ToldSoFar, Trig


@dataclass(slots=True)
class Displays(ToldSoFar):
    """What stands apart from the text: chains of steps side by side, conditions, laws."""

    def answer(self, *names: Shown, trig: Trig = None, entries: str = "", lines: int = 2) -> str:
        """The same as `show` for what was asked, which stands in a frame."""
        return self.show(*names, trig=trig, entries=entries, lines=lines, answer=True)

    def result(self, caller: Callable[[], str], end: str = "") -> str:
        """What words say of the answer without a frame, between `{% call result() %}` and `{% endcall %}`: a
        key to the sheet has it too, there with this `end`."""
        first = len(self.printed)
        written = caller()
        if self.asked:
            self.answered.append(f"{written.rstrip()}{end}\n\n")
            self.kept.extend(self.printed[first:])
        return written

    def show(
        self,
        *names: Shown,
        trig: Trig = None,
        entries: str = "",
        lines: int = 2,
        answer: bool = False,
        brief: bool = False,
    ) -> str:
        """A displayed equation of one or several steps (or bare chains), side by side where they fit.

        Long entries of a matrix too wide for the page are named, and listed after it; `entries` are words to
        stand before the list, and then no matrix is wider than a line. A spare link is left out where it
        takes more than so many `lines`. In a key what is `brief` has its values alone.
        """
        printer, widest = self._printer(trig), LINE if entries else NAMED_BEYOND
        boxed = answer and self.asked
        whole = [self._chain(name, printer, lines) for name in names]
        if (boxed and self.level == "answers") or (brief and self.level != "full"):
            whole = [(chain[0], chain[-1]) if len(chain) > 1 else chain for chain in whole]
        parts = [
            with_named_entries(chain, printer, widest, self._entries(name))
            for chain, name in zip(whole, names, strict=True)
        ]
        both = zip(whole, parts, strict=True)
        namings = tuple(
            Naming(chain[0], chain[-1], shown[-1], tuple((name, tree) for name, tree in listed))
            for chain, (shown, listed) in both
            if listed
        )
        first = len(self.printed)
        shown = self._display(tuple(chain for chain, _ in parts), printer, namings, answer)
        listed = [self._display(chains, printer) for _, chains in parts if chains]
        written = "".join((shown, f"\n{entries}\n" if entries and listed else "", *listed))
        if boxed:
            self.answered.append(written)
            self.kept.extend(self.printed[first:])
        return written

    def lengthy(self, name: str | Step, scaled: bool = False) -> bool:
        """Whether the matrix in which a step ends is wider than a line, so that entries of it are listed; one
        that may be `scaled` can be somewhat wider."""
        step, printer = self._step(name), self._printer(None)
        widest = NAMED_BEYOND if scaled else LINE
        return bool(with_named_entries(self.values.shown(step.chain), printer, widest, step.entries)[1])

    def _display(
        self, chains: tuple[tuple[Expr, ...], ...], printer: Printer, namings: tuple[Naming, ...] = (),
        answer: bool = False,
    ) -> str:  # fmt: skip
        links = tuple(chain_links(chain, printer) for chain in chains)
        boxed = answer and self.asked
        display = lay_out(links, printer.notation, FRAMED if boxed else NUMBERED if answer else LINE)
        self.printed.append(Printed.display(display, printer.notation, namings))
        written = self.skin.display(replace(display, boxed=boxed))
        self.displays += 1
        equation = Equation(self.so_far.problem, chains, self.d, self.displays, answer)
        return self.so_far.marked(written, equation, boxed)

    def conditions(self, relations: tuple[Relation, ...]) -> str:
        """Conditions that all hold, side by side; where they are the answer, in a frame."""
        self.said.extend(parts(relations))
        printer = self._printer(None)
        styled = tuple(map(self.speech.in_style, relations))
        display = lay_out(tuple(signed_links(each, printer) for each in styled), printer.notation, FRAMED)
        self.printed.append(Printed(display.lines, tuple(map(links_of, styled)), printer.notation))
        written = self.skin.display(replace(display, boxed=self.asked))
        if self.asked:
            self.answered.append(written)
            self.kept.append(self.printed[-1])
        return written

    def formula(self, *lines: str) -> str:
        """A general law, displayed as the words write it in LaTeX; what is derived goes through `show`."""
        self.printed.append(Printed(lines, (), self.notation))
        return self.skin.display(Display(lines))
