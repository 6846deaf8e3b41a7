"""What is wrong with the words of a kind: steps they leave out or tell too early, names that are nowhere."""

from __future__ import annotations

from collections.abc import Iterable


class ForgottenStep(Exception):
    """The words of a kind left out steps of its derivation."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} neither show nor tell: {', '.join(names)}")


class UnknownFamily(Exception):
    """The words of a kind speak of names that its derivation has not."""

    def __init__(self, kind: str, letter: str) -> None:
        super().__init__(f"the words of {kind} speak of {letter} with an index, and nothing is called so")


class ForgottenFact(Exception):
    """The words of a kind leave out what its derivation gives them to say."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} do not say these facts: {', '.join(names)}")


class EarlyStep(Exception):
    """The words of a kind tell steps in another order than they were derived in."""

    def __init__(self, kind: str, names: Iterable[str]) -> None:
        super().__init__(f"the words of {kind} tell before what was derived first: {', '.join(names)}")
