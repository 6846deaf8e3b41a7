"""The documentation builds as a site, by itself: every page is reached, nothing is fetched from elsewhere."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from derive import __version__
from derive.kinds import registry
from derive.sheet.subjects.registry import subjects
from tests.commands import run
from tests.sheets import ROOT

FETCHED = re.compile(r"""<(?:script|img|link|iframe)[^>]+(?:src|href)=["'](?:https?:)?//""")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The site, with two pages in its gallery."""
    folder = tmp_path_factory.mktemp("site")
    environment = {**os.environ, "DERIVE_GALLERY": "robot-jacobian sheet-planar-2r"}
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return folder


def test_every_page_is_there_and_fetches_nothing(site: Path) -> None:
    home = (site / "index.html").read_text(encoding="utf-8")
    pages = {page.relative_to(site).as_posix() for page in site.rglob("*.html")}
    linked = {target.removeprefix("./") for target in re.findall(r'href="([\w./-]+\.html)"', home)}
    assert linked >= {page for page in pages if "/" not in page and page not in ("index.html", "404.html")}
    assert linked <= pages
    for page in pages:
        text = (site / page).read_text(encoding="utf-8")
        assert not FETCHED.search(text), page
        assert not re.search(r"\$[^$\n<]+\$", re.sub(r"<(code|pre)\b.*?</\1>", "", text, flags=re.DOTALL)), (
            page
        )


def test_its_reference_and_gallery_have_every_kind(site: Path) -> None:
    gallery = (site / "gallery" / "index.html").read_text(encoding="utf-8")
    kinds = (site / "reference" / "kinds.html").read_text(encoding="utf-8")
    for subject in subjects():
        for kind in registry.kinds_of(subject):
            assert f"{kind} of {subject}</h3>" in kinds
            assert kind in gallery
    assert 'href="robot-jacobian.html"' in gallery
    assert "<math" in (site / "gallery" / "robot-jacobian.html").read_text(encoding="utf-8")
    assert "derive watch" in (site / "reference" / "command.html").read_text(encoding="utf-8")


def test_the_release_is_of_one_version() -> None:
    """The tag that the workflow asks for is the version of the project, and so is what is cited."""
    cited = YAML(typ="safe").load(ROOT / "CITATION.cff")
    assert cited["version"] == __version__
    assert run("--version").stdout == f"derive, version {__version__}\n"
    workflow = YAML(typ="safe").load(ROOT / ".github" / "workflows" / "release.yml")
    (held,) = (
        step["run"] for step in workflow["jobs"]["build"]["steps"] if "the version" in step.get("name", "")
    )
    for tag, right in ((f"v{cited['version']}", True), ("v9.9.9", False)):
        environment = {**os.environ, "GITHUB_REF_NAME": tag}
        done = subprocess.run(["bash", "-c", held], cwd=ROOT, env=environment, check=False)
        assert (done.returncode == 0) is right
