"""How much work a search may take: counted, never by the clock, so that it ends the same everywhere."""

from __future__ import annotations

from dataclasses import dataclass

from derive.algebra.solving.factors import TooLong


@dataclass(slots=True)
class Budget:
    """Terms, or products of terms, that may still be made: the same on every machine."""

    left: int

    def spend(self, terms: int) -> None:
        """Raises TooLong where they are more than are left."""
        self.left -= terms
        if self.left < 0:
            raise TooLong
