"""The composer of the YAML parser, stopped before a file of too many values has been read through."""

from __future__ import annotations

from typing import Any

from ruamel.yaml.composer import Composer, ComposerError

MAX_VALUES = 40_000  # of a sheet
TOO_MANY = "too many values"


class Counting(Composer):
    """Raises ComposerError at the first node that is too many; a key is one, its value another."""

    def __init__(self, loader: Any = None) -> None:
        super().__init__(loader=loader)
        self.warn_double_anchors = False
        self.nodes = 0

    def compose_node(self, parent: Any, index: Any) -> Any:
        """The node, counted. Raises ComposerError where there are too many."""
        self.nodes += 1
        if self.nodes > 2 * MAX_VALUES:
            raise ComposerError(None, None, TOO_MANY, self.parser.peek_event().start_mark)
        return super().compose_node(parent, index)
