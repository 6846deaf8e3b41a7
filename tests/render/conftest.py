from __future__ import annotations

from collections.abc import Iterator

import pytest
from jinja2 import ChoiceLoader, DictLoader

from derive.render.skin import environment
from tests.render import sample


@pytest.fixture
def sample_words(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The words of the sample beside those of the program."""
    found = environment()
    assert found.loader is not None
    loader = ChoiceLoader([DictLoader(sample.WORDS), found.loader])
    monkeypatch.setattr(found, "loader", loader)
    yield
