"""A process that works on one sheet after another, as it is told by the one that started it.

What it is told and what it answers are pickled values on its standard input and output; whatever else is
printed goes to the standard error. It ends when nobody tells it anything more.
"""

from __future__ import annotations

import gc
import os
import pickle
import signal
import sys
from pathlib import Path
from traceback import print_exc
from typing import BinaryIO

from derive.jobs.one import accident, done
from derive.jobs.wanted import Outcome, Task, Wanted
from derive.render.own_templates import dressed


def serve(asked: BinaryIO) -> None:
    """Answers what is asked there, until it ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it is ended by the one that started it
    gc.set_threshold(100_000, 50, 50)  # trees are many and hold no cycles
    told = os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    try:
        wanted, folder = pickle.load(asked)
        with dressed(wanted.templates):
            while True:
                pickle.dump((_answer(pickle.load(asked), wanted, folder), _memory()), told)
                told.flush()
    except (EOFError, BrokenPipeError):
        os._exit(0)


def _answer(task: Task, wanted: Wanted, folder: Path | None) -> Outcome | OSError:
    try:
        return done(task, wanted, folder, lambda _: None)
    except OSError as error:
        return OSError(error.errno, error.strerror or str(error), error.filename)
    except Exception as error:  # DERIVE_DEBUG is set
        print_exc()
        return Outcome(accident=accident(error, task.sheet))


def _memory() -> int:
    """Bytes that this process holds, or has held at most; 0 where neither is known."""
    if sys.platform == "linux":
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    if sys.platform == "darwin":
        from resource import RUSAGE_SELF, getrusage

        return getrusage(RUSAGE_SELF).ru_maxrss
    return 0
