from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

from tests.commands import SHEET

# The same examples on every run, so that a failure of the gate is a failure anyone gets again;
# `--hypothesis-profile=search` looks further.
settings.register_profile("gate", max_examples=40, deadline=None, derandomize=True)
settings.register_profile("search", max_examples=1000, deadline=None)
settings.load_profile("gate")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden",
        action="store_true",
        help="write the pages of exercises/ to output/ instead of comparing with them",
    )


@pytest.fixture
def update_golden(request: pytest.FixtureRequest) -> bool:
    return bool(request.config.getoption("--update-golden"))


@pytest.fixture(autouse=True, scope="session")
def stamps(tmp_path_factory: pytest.TempPathFactory) -> None:
    """What is known of sheets that were built lies with the rest of what tests leave behind."""
    os.environ["DERIVE_CACHE"] = str(tmp_path_factory.mktemp("stamps"))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder that commands are typed in, with one sheet."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "week1.yaml").write_text(SHEET, encoding="utf-8")
    return tmp_path
