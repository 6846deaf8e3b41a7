"""Compiled templates that lie in the user's folder: taken from there, made again where they are no good."""

from __future__ import annotations

from pathlib import Path

import pytest
from jinja2 import DictLoader, Environment

from derive.render.compiled import Compiled, compiled_before


def made(folder: Path, text: str = "{{ 1 + 1 }}") -> str:
    environment = Environment(loader=DictLoader({"page": text}), bytecode_cache=Compiled(str(folder)))
    return environment.get_template("page").render()


def test_another_process_takes_what_lies_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert made(tmp_path / "new") == "2"
    monkeypatch.setattr(Environment, "compile", lambda *_: pytest.fail("compiled again"))
    assert made(tmp_path / "new") == "2"


def test_another_text_is_compiled(tmp_path: Path) -> None:
    assert made(tmp_path) == "2"
    assert made(tmp_path, "{{ 2 + 2 }}") == "4"


@pytest.mark.parametrize("rubbish", [b"", b"rubbish", None], ids=["nothing", "rubbish", "cut off"])
def test_what_cannot_be_read_is_made_again(tmp_path: Path, rubbish: bytes | None) -> None:
    made(tmp_path)
    (file,) = tmp_path.iterdir()
    whole = file.read_bytes()
    for end in range(len(whole)) if rubbish is None else [0]:
        file.write_bytes(whole[:end] if rubbish is None else rubbish)
        assert made(tmp_path) == "2"


def test_where_nothing_can_be_written_all_is_compiled(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert made(tmp_path / "file" / "below") == "2"


def test_what_others_can_write_is_not_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "shared"
    made(folder)
    folder.chmod(0o777)
    (file,) = folder.iterdir()
    before = file.stat().st_mtime_ns
    loaded = []
    monkeypatch.setattr("jinja2.bccache.Bucket.load_bytecode", lambda *_: loaded.append(1))
    assert made(folder) == "2"
    assert not loaded and file.stat().st_mtime_ns == before


def test_the_folder_is_the_users(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DERIVE_CACHE", str(tmp_path))
    found = compiled_before(Environment())
    other = compiled_before(Environment(trim_blocks=True))
    assert found is not None and Path(found.directory) == tmp_path / "templates"
    assert other is not None and other.pattern != found.pattern
