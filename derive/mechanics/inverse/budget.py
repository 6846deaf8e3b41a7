"""How much may be tried before a search is given up: counted in terms, so that it is the same everywhere."""

from __future__ import annotations

from dataclasses import dataclass, field

# A UR5 takes 44,000 terms of equations, six joints with every length and twist a letter 3 million.
MOST = 5_000_000


class Spent(Exception):
    """The search tried as much as it may."""


@dataclass(slots=True)
class Budget:
    """Raises Spent once more terms were tried than it holds."""

    most: int = MOST
    tried: int = field(default=0)

    def spend(self, terms: int) -> None:
        self.tried += terms
        if self.tried > self.most:
            raise Spent
