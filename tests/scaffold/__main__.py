"""Begins a new kind, and ends it: `python3 -m tests.scaffold SUBJECT KIND`."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from io import StringIO
from pathlib import Path
from string import Template
from typing import Any, get_args, get_type_hints

from ruamel.yaml import YAML

from derive import catalogue
from derive.kinds import registry as kinds
from derive.render.questions import example_of
from derive.sheet.reference import reference
from derive.sheet.subjects import registry as subjects

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
OPEN = "FILL IN"
NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
TABLE = re.compile(r"(?<=format markdown` -->).*?(?=<!-- /kinds -->)", re.DOTALL)
FIELDS = re.compile(r"(?<=format reference` -->).*?(?=<!-- /fields -->)", re.DOTALL)
NEXT = """\
It builds as it stands: python3 -m derive exercises/{kind}.yaml --format md --output -
Fill in what says FILL IN, then: python3 -m tests.scaffold {subject} {kind}"""


def main(subject: str, kind: str) -> str:
    """What was done and what is next. Raises SystemExit with what is wrong."""
    if subject not in subjects.subjects():
        raise SystemExit(f"there is no subject '{subject}': choose {', '.join(subjects.subjects())}")
    if not NAME.fullmatch(kind):
        raise SystemExit(
            f"'{kind}' is no name of a kind: write small letters with hyphens, as pseudo-inverse"
        )
    own = f"derive.kinds.{subject}.{kind.replace('-', '_')}"
    if (known := kinds.kinds_of(subject).get(kind, own)) != own:
        raise SystemExit(f"{subject} has a kind '{kind}' already: {known}")
    if missing := {path: text for path, text in files(subject, kind).items() if not path.exists()}:
        return _begun(subject, kind, missing)
    return _ended(subject, kind)


def files(subject: str, kind: str) -> dict[Path, str]:
    """The three files of a kind, and what they begin as."""
    stem, example = kind.replace("-", "_"), _example(subject, kind)
    filled = {"kind": kind, "subject": subject, "example": example, **_type(subject)}
    module = ROOT / "derive" / "kinds" / subject / f"{stem}.py"
    words = ROOT / "templates" / "words" / subject / f"{stem}.j2"
    made = {module: "kind.py.txt", words: "words.j2.txt"}
    texts = {path: Template((HERE / name).read_text()).substitute(filled) for path, name in made.items()}
    return {**texts, ROOT / "exercises" / f"{kind}.yaml": example}


def _example(subject: str, kind: str) -> str:
    """A sheet that asks this kind of the shortest subject in the examples of other kinds."""
    yaml = YAML()
    yaml.width = 10**6
    title = kind.replace("-", " ").capitalize()
    asked = ({**problem, "find": kind} for problem in _problems(subject, yaml))
    sheets = [_dumped(yaml, {"title": title, "problems": [problem]}) for problem in asked]
    return min(sheets, key=len)


def _problems(subject: str, yaml: YAML) -> Iterator[dict[str, Any]]:
    """What is given in the examples about a subject, without the questions."""
    for known in kinds.kinds_of(subject):
        for problem in yaml.load(example_of(kinds.module_name(subject, known)))["problems"]:
            if subject in problem:
                yield {key: problem[key] for key in (subject, "where", "assumptions") if key in problem}


def _dumped(yaml: YAML, sheet: dict[str, Any]) -> str:
    written = StringIO()
    yaml.dump(sheet, written)
    return written.getvalue()


def _type(subject: str) -> dict[str, str]:
    """The class of a subject, and the line that imports it."""
    made = get_type_hints(subjects.load(subject).build)["return"]
    parts = get_args(made) or (made,)
    lines = [f"from {each.__module__} import {each.__name__}" for each in parts]
    return {"type": " | ".join(each.__name__ for each in parts), "import_subject": "\n".join(lines)}


def _begun(subject: str, kind: str, missing: dict[Path, str]) -> str:
    for path, text in missing.items():
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    _tidy(subject, kind)
    said = "\n".join(f"written: {path.relative_to(ROOT)}" for path in missing)
    return f"{said}\n{NEXT.format(subject=subject, kind=kind)}"


def _ended(subject: str, kind: str) -> str:
    """README's table, that of all fields and the pages of the sheet, once nothing is left to be filled in."""
    if left := list(_left(subject, kind)):
        raise SystemExit("\n".join(["this is still to be filled in:", *left]))
    _tidy(subject, kind)
    _paste("README.md", TABLE, catalogue.table())
    _paste("docs/language.md", FIELDS, reference())
    golden = ("tests/test_golden.py", "--update-golden", "-k", f"kept and {kind}")
    _run("pytest", "-n0", *golden)
    written = f"README.md, docs/language.md and output/{kind}.* are written"
    return f"{written}: look at them. Then: pytest -k {kind}, and just check"


def _paste(page: str, place: re.Pattern[str], text: str) -> None:
    """Writes text anew at its place in a page."""
    path = ROOT / page
    path.write_text(place.sub(lambda _: f"\n\n{text}\n", path.read_text(encoding="utf-8")), encoding="utf-8")


def _left(subject: str, kind: str) -> Iterator[str]:
    for path in files(subject, kind):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if OPEN in line:
                yield f"{path.relative_to(ROOT)}:{number}: {line.strip()}"


def _tidy(subject: str, kind: str) -> None:
    module = str(next(iter(files(subject, kind))))
    _run("ruff", "check", "-q", "--fix-only", "--select", "I,F401", module)
    _run("ruff", "format", "-q", module)


def _run(*command: str) -> None:
    """Raises SystemExit with what it says where it fails."""
    python = (sys.executable, "-m", *command)
    done = subprocess.run(python, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        raise SystemExit(done.stdout + done.stderr)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        raise SystemExit("usage: python3 -m tests.scaffold SUBJECT KIND, such as robot pseudo-inverse")
    print(main(*sys.argv[1:]))
