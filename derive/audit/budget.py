"""How much work one answer is worth. Operations are counted, what SymPy does for itself before it begins
(`algebra`), so that what is too much is too much on every machine. A clock stands behind that as a last
safety: what it stops is a fault, and no answer that is passed over."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

MOST = 3_000_000  # operations on numbers, some ten seconds
SECONDS = 300.0


class Exhausted(Exception):
    """More work than an answer is worth."""


class Endless(BaseException):
    """SymPy does not come to an end. Nothing that deals with accidents takes it for one."""


class _Account:
    left = MOST


def spend(operations: int) -> None:
    """Takes operations from what is left. Raises Exhausted."""
    _Account.left -= operations
    if _Account.left < 0:
        raise Exhausted


@contextmanager
def one_answer() -> Iterator[None]:
    """The work within is on one answer. Raises Exhausted where it is too much, Endless where the clock stops
    what was not counted."""
    _Account.left = MOST
    if not hasattr(signal, "setitimer") or threading.current_thread() is not threading.main_thread():
        yield
        return
    before = signal.signal(signal.SIGALRM, _stop)
    signal.setitimer(signal.ITIMER_REAL, SECONDS)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _stop(number: int, frame: FrameType | None) -> None:
    raise Endless
