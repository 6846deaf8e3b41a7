"""A sheet beside its editor: `derive watch --serve` in a browser, as its author sees it."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.commands import LONGEST, SHEET, started
from tests.live.browser import Tab, browser
from tests.render.test_browser import AXE

FRAME = "document.querySelector('iframe:not(.next)')"
INSIDE = f"{FRAME}.contentDocument"
QUESTIONS = """\
  questions:
  - find: dh-table
  - find: forward-kinematics
  - find: jacobian
  - find: singularities
"""


class Live:
    """A watched sheet, and the tab that shows it."""

    def __init__(self, sheet: Path, tab: Tab, process: subprocess.Popen[str], address: str) -> None:
        self.sheet, self.tab, self.process, self.address = sheet, tab, process, address

    def save(self, text: str) -> None:
        self.sheet.write_text(text, encoding="utf-8")

    def shows(self, text: str) -> None:
        """Waits until the page says so."""
        self.tab.until(f"{FRAME} && {INSIDE}.body && {INSIDE}.body.textContent.includes({text!r})")


@pytest.fixture
def live(tmp_path: Path) -> Iterator[Live]:
    sheet = tmp_path / "arm.yaml"
    sheet.write_text(SHEET.replace("  find: dh-table\n", QUESTIONS), encoding="utf-8")
    command = [sys.executable, "-m", "derive", "watch", "arm.yaml", "--serve"]
    with started(command, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        try:
            assert process.stderr
            found = re.search(r"http://127\.0\.0\.1:\d+/\S+", process.stderr.readline())
            assert found
            with browser(tmp_path / "profile") as tab:
                tab.go(found[0])
                yield Live(sheet, tab, process, found[0])
        finally:
            process.kill()


def judged(tab: Tab) -> list[str]:
    """What axe-core finds at fault with all that can be opened around the page, which is judged elsewhere."""
    tab.value("document.querySelectorAll('header button').forEach(each => each.click())")
    tab.value(f"{AXE.read_text(encoding='utf-8')}; 1")
    found: list[str] = tab.value(
        "axe.run(document, {iframes: false}).then(judged => judged.violations.map(each => each.id))"
    )
    return found


def test_it_follows_the_sheet(live: Live) -> None:
    tab = live.tab
    good = live.sheet.read_text(encoding="utf-8")
    live.shows("A planar arm")
    tab.value(f"{INSIDE}.getElementById('question-1-3').scrollIntoView()")
    place = f"{INSIDE}.getElementById('question-1-3').getBoundingClientRect().top"
    assert abs(tab.value(place)) < 1

    live.save(good.replace("find: jacobian", "find: jacobain"))  # the last good page stays
    tab.until("!document.getElementById('faults').hidden")
    said = tab.value("document.getElementById('faults').innerText")
    assert (
        "arm.yaml:9:11: there is no kind 'jacobain' for robot\n      - find: jacobain\n              ^"
        in said
    )
    assert "did you mean jacobian?" in said
    assert tab.value("document.title") == "1 fault: arm.yaml"
    live.shows("Question 3")
    assert tab.value(f"{INSIDE}.getElementById('question-1-3').style.borderInlineStart") != ""
    assert tab.value(f"{INSIDE}.getElementById('question-1-2').style.borderInlineStart") == ""
    assert judged(tab) == []
    tab.value("document.querySelector('button.said').click()")
    assert tab.value("document.querySelector('li.wrong mark').textContent") == "jacobain"

    live.save(
        good.replace("A planar arm", "Another arm").replace(
            "- find: dh-table", "- find: dh-table\n    hint: Look."
        )
    )
    live.shows("Another arm")
    assert tab.value("document.getElementById('faults').hidden")
    assert tab.value("document.title") == "arm.yaml"
    assert abs(tab.value(place)) < 1  # though a line was put in above

    live.process.send_signal(signal.SIGINT)
    said = live.process.communicate(timeout=LONGEST)[1]
    assert live.process.returncode == 0
    assert "Traceback" not in said
    tab.until("document.title.startsWith('ended')")
    live.shows("Another arm")


def test_from_a_formula_to_its_lines_and_back(live: Live) -> None:
    tab = live.tab
    live.shows("A planar arm")
    lines = "[...document.querySelectorAll('li.here button')].map(each => +each.textContent)"
    after = "each.compareDocumentPosition(heading) & Node.DOCUMENT_POSITION_PRECEDING"
    formula = (
        f"(heading => [...{INSIDE}.querySelectorAll('.answer math')].find(each => {after}))"
        f"({INSIDE}.getElementById('question-1-3'))"
    )
    tab.value(f"{formula}.scrollIntoView({{block: 'center'}})")
    box = "(({x, y, width, height}, at) => ({x: x + at.x, y: y + at.y, width, height}))"
    tab.click(f"{box}({formula}.getBoundingClientRect(), {FRAME}.getBoundingClientRect())")
    assert tab.until(f"{lines}.length && {lines}") == [9]
    assert tab.value("document.querySelectorAll('#source li').length") == len(SHEET.splitlines()) + 4

    tab.value(
        "[...document.querySelectorAll('#source button')].find(each => each.textContent == '10').click()"
    )
    top = tab.value(f"{INSIDE}.getElementById('question-1-4').getBoundingClientRect().top")
    assert 0 <= top < tab.value("innerHeight")

    tab.value("document.getElementById('show-proved').click()")
    assert "question 1.3, jacobian" in tab.value("document.getElementById('proved').innerText")

    tab.value(
        "(each => { each.value = 'answers'; each.dispatchEvent(new Event('change')); })"
        "(document.getElementById('steps'))"
    )
    tab.until(f"{INSIDE}.querySelectorAll('math').length < 40")
