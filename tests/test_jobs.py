"""Several sheets in one command: in processes beside each other they come to what they do one by one."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from time import sleep

import pytest

from tests.commands import LONGEST, SHEET, run, started, until

MODULE = '''
"""The trace of the rotation, and trouble."""
import os, signal, time
from typing import Literal
from derive.derivation import Derivation, PageFacts, Step
from derive.errors import NotDerivable
from derive.expression import Symbol
from derive.kinds.checks import law
from derive.kinds.fields import OptionsModel


class Facts(PageFacts):
    how: str = ""


class Options(OptionsModel):
    """What happens."""
    how: Literal["fine", "crash", "words", "die", "slow", "refuse"] = "fine"


def derive(motion, options, problem):
    if options.how == "crash":
        raise KeyError("x")
    if options.how == "die":
        os.kill(os.getpid(), signal.SIGKILL)
    if options.how == "refuse":
        raise NotDerivable("there is none")
    if options.how == "slow":
        time.sleep(2 * 60)
    R = problem.ask("rotation-matrix")
    tree = problem.final(R.results["R"].rows[0][0])
    steps = (Step("trace", (Symbol("trace"), tree)),)
    claims = (law("itself", tree == tree),)
    return Derivation("trouble", steps, {"trace": tree}, claims, facts=Facts(how=options.how))
'''
WORDS = (
    "{% block results %}\ntrace: the sum of the diagonal\n{% endblock %}\n"
    "{% block question %}What is the first entry?{% endblock %}\n"
    "{% block phrases %}\nitself: it is itself\n{% endblock %}\nIts first entry is\n{{ show('trace') }}\n"
    "{% if facts.how == 'words' %}{{ 1 // 0 }}{% endif %}\n"
)
TROUBLE = "title: t\nproblems:\n- motion: [{rotate: z, by: phi}]\n  find: trouble\n  how: %s\n"
PAGES = {"a.md", "b.md", "a/problem-1-figure.svg", "b/problem-1-figure.svg"}


@pytest.fixture
def trouble(folder: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder, and beside it a package with a kind that does what a sheet tells it to."""
    package = folder / "packages" / "theirs"
    info = folder / "packages" / "theirs-1.0.dist-info"
    for place in (package, info):
        place.mkdir(parents=True)
    (package / "__init__.py").write_text("")
    (package / "trouble.py").write_text(MODULE)
    (package / "trouble.j2").write_text(WORDS)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: theirs\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[derive.kinds]\nmotion/trouble = theirs.trouble\n")
    monkeypatch.syspath_prepend(str(package.parent))
    monkeypatch.delenv("DERIVE_DEBUG", raising=False)
    return folder


def written(folder: Path) -> Mapping[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def sheets(folder: Path, **texts: str) -> list[str]:
    for name, text in texts.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return [f"{name}.yaml" for name in texts]


def test_processes_write_what_one_process_does(folder: Path) -> None:
    strange = SHEET.replace("problems:", "where: {unused: 1}\nproblems:")
    asked = sheets(folder, d=SHEET, b=strange, c=SHEET.replace("dh-table", "jacobian"), a=strange)
    both = [run(*asked, "--format", "md,json", "--output", f"by{n}", "--jobs", str(n)) for n in (1, 2)]
    alone, together = both
    assert written(folder / "by1") == written(folder / "by2")
    assert together.stderr == alone.stderr.replace("by1", "by2")
    assert [line[:1] for line in together.stderr.splitlines() if "warning" in line] == ["b", "a"]
    assert [line[4:5] for line in together.stderr.splitlines() if line.endswith(".md")] == [*"dbca"]


@pytest.mark.parametrize("wrong", [SHEET.replace("find", "fnd"), TROUBLE % "refuse"], ids=["given", "asked"])
def test_faults_come_in_the_order_of_the_sheets(trouble: Path, wrong: str) -> None:
    asked = sheets(trouble, d=wrong, b=SHEET, c=wrong, a=wrong)
    alone, together = (run(*asked, "--format", "md", "--jobs", str(n)) for n in (1, 2))
    assert (together.exit_code, together.stderr) == (alone.exit_code, alone.stderr)
    assert together.exit_code == 1
    first = [line[0] for line in together.stderr.splitlines() if line[1:7] == ".yaml:"]
    assert list(dict.fromkeys(first)) == [*"dca"]
    assert together.stderr.endswith("; nothing was written\n")
    assert not (trouble / "output").exists()


def test_an_accident_is_a_fault_of_its_sheet(trouble: Path) -> None:
    """In deriving and in telling alike; the other sheets are written."""
    asked = sheets(trouble, d=TROUBLE % "words", b=SHEET, c=TROUBLE % "crash", a=TROUBLE % "fine")
    alone, together = (run(*asked, "--format", "md", "--output", f"by{n}", "--jobs", str(n)) for n in (1, 2))
    assert together.stderr == alone.stderr.replace("by1", "by2")
    assert (alone.exit_code, together.exit_code) == (1, 1)
    assert written(trouble / "by1").keys() == PAGES
    assert written(trouble / "by1") == written(trouble / "by2")
    told = [line for line in together.stderr.splitlines() if "should not have" in line]
    assert [line.partition(" derive")[0] for line in told] == ["d.yaml:4:9:", "c.yaml:4:9:"]
    assert together.stderr.endswith("2 faults; the other sheets were written\n")
    assert "Traceback" not in together.output
    one = run("d.yaml", "--format", "md", "--output", "one")
    assert (one.exit_code, one.stderr.splitlines()[-1]) == (1, "1 fault; nothing was written")


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_a_process_that_dies_takes_only_its_sheet_along(trouble: Path) -> None:
    asked = sheets(trouble, b=SHEET, d=TROUBLE % "die", a=TROUBLE % "fine", c=TROUBLE % "die")
    done = run(*asked, "--format", "md", "--jobs", "2")
    assert done.exit_code == 1
    assert [line[:7] for line in done.stderr.splitlines() if "signal 9" in line] == ["d.yaml:", "c.yaml:"]
    assert written(trouble / "output").keys() == PAGES


@pytest.mark.skipif(not Path("/proc/self").exists(), reason="looks into /proc")
@pytest.mark.parametrize("sign", [signal.SIGINT, signal.SIGKILL])
def test_processes_end_with_the_command(trouble: Path, sign: signal.Signals) -> None:
    """With Ctrl-C at once and without litter; behind a command that was killed when their sheet is built."""
    sheets(trouble, a=TROUBLE.replace("%s", "slow"), b=TROUBLE.replace("%s", "slow"))
    slow = MODULE if sign == signal.SIGINT else MODULE.replace("sleep(2 * 60)", "sleep(3)")
    (trouble / "packages" / "theirs" / "trouble.py").write_text(slow)
    command = [sys.executable, "-m", "derive", "a.yaml", "b.yaml", "--format", "md", "--jobs", "2"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "MARK": str(trouble)}
    build = started(command, env=environment, stderr=subprocess.PIPE)
    try:
        until(lambda: len(_marked(trouble)) >= 3 and [*trouble.glob("output/.derive-*")], build)
        sleep(1)
        build.send_signal(sign)
        said = build.communicate(timeout=LONGEST)[1]
        until(lambda: not _marked(trouble))
    finally:
        for left in _marked(trouble):
            os.kill(int(left), signal.SIGKILL)
    if sign == signal.SIGINT:
        assert (build.returncode, said) == (1, b"\nAborted!\n")
        assert not (trouble / "output").exists()


def _marked(folder: Path) -> list[str]:
    """The processes that were started with this mark in their environment."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        try:
            if f"MARK={folder}".encode() in (process / "environ").read_bytes():
                found.append(process.name)
        except OSError:
            continue
    return found
