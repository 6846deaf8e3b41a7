"""Pages in HTML as a browser has them, wide and narrow, by day and by night, judged by axe-core."""

from __future__ import annotations

import json
import re
import subprocess
from functools import cache
from html import escape, unescape
from pathlib import Path
from typing import Any

import axe_core_python
import pytest

from tests.sheets import ROOT, pages

SHEETS = ("week3", "dc-motor")  # tables of formulas, wide matrices, programs and plots
AXE = Path(axe_core_python.__file__).parent / "axe.min.js"
RULES = ("wcag2a", "wcag2aa", "wcag21aa", "best-practice")
TELL = """
<script>{axe}</script>
<script>
const tell = found => {{
  const told = document.createElement("pre");
  told.id = "told";
  told.textContent = JSON.stringify(found);
  parent.document.body.append(told);
}};
const judge = () => axe.run(document.querySelector("main"), {{runOnly: {rules}}});
document.fonts.ready.then(judge).then(judged => tell({{
  faults: judged.violations.map(fault => [fault.id, fault.nodes[0].html.slice(0, 200)]),
  window: innerWidth,
  page: document.documentElement.scrollWidth,
  dark: matchMedia("(prefers-color-scheme: dark)").matches,
  paper: getComputedStyle(document.body).backgroundColor,
  font: document.fonts.check('16px "Sheet Math"'),
  fetched: performance.getEntriesByType("resource").filter(each => !each.name.startsWith("data:")).length,
}}));
</script>
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("html")


@cache
def page(sheet: str, folder: Path) -> str:
    """The page with what tells about it at its end."""
    made = pages(ROOT / f"exercises/{sheet}.yaml", folder, "html")
    (text,) = (path.read_text(encoding="utf-8") for path in made if path.suffix == ".html")
    tell = TELL.format(axe=AXE.read_text(encoding="utf-8"), rules=json.dumps(RULES))
    return text.replace("</body>", f"{tell}</body>")


def told(page: str, width: int, dark: bool, folder: Path) -> dict[str, Any]:
    """What a browser tells of a page in a frame of this width: its own windows are never narrow."""
    frame = folder / f"{width}.html"
    frame.write_text(
        f'<meta charset="utf-8"><iframe width="{width}" height="900" srcdoc="{escape(page)}"></iframe>'
    )
    scheme = f"--blink-settings=preferredColorScheme={0 if dark else 1}"
    options = ["--headless", "--no-sandbox", "--disable-gpu", "--window-size=1300,1000", scheme]
    command = ["chromium", *options, "--virtual-time-budget=5000", "--dump-dom", frame.as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = re.search(r'<pre id="told">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found, done.stderr[-500:]
    answer: dict[str, Any] = json.loads(unescape(found[1]))
    return answer


@pytest.mark.parametrize("sheet", SHEETS)
@pytest.mark.parametrize(("width", "dark"), [(1200, False), (320, True)])
def test_everyone_can_read_it(sheet: str, width: int, dark: bool, folder: Path) -> None:
    found = told(page(sheet, folder), width, dark, folder)
    assert found["faults"] == []
    assert found["page"] <= found["window"] == width
    assert found["fetched"] == 0
    assert found["font"]
    assert (found["dark"], found["paper"] == "rgb(255, 255, 255)") == (dark, not dark)
