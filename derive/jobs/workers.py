"""Processes that work on sheets beside each other. One that dies takes only its own sheet along."""

from __future__ import annotations

import pickle
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from queue import Empty, SimpleQueue
from threading import Thread
from types import TracebackType
from typing import TypeAlias

from derive.errors import SheetError
from derive.jobs.wanted import Outcome, Task, Wanted
from derive.messages import REPORT

START = """\
import os, pickle, sys
asked = os.fdopen(os.dup(0), "rb")
sys.path[:] = pickle.load(asked)
from derive.jobs.worker import serve
serve(asked)
"""
LARGE = 180_000_000  # bytes; a process that holds so many is let go, its sheet done: two stay below 400 MB
KILLED = 9
OFTEN = 0.5  # seconds after which Ctrl-C is looked for, where nothing else happens
NAMED = 4  # sheets at work that are told
DOING = {"read": "reading the sheets", "build": "building the sheets"}
Event: TypeAlias = tuple[Task, Outcome | BaseException | None]


class Workers:
    """At most so many processes at a time; each starts with its first task. They end with the block."""

    def __init__(self, count: int, wanted: Wanted, folder: Path | None) -> None:
        self.count = count
        self.hello = pickle.dumps(sys.path) + pickle.dumps((wanted, folder))
        self.idle: list[_Worker] = []
        self.all: list[_Worker] = []
        self.closed = False

    def __enter__(self) -> Workers:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: object, at: TracebackType | None) -> None:
        self.closed = True
        for worker in self.all:
            worker.end()

    def outcomes(self, tasks: Sequence[Task], progress: Callable[[str], None]) -> list[Outcome]:
        """What came of each task, in their order. The largest files go first, so that the processes end
        together. Raises OSError."""
        begun: dict[Task, Outcome | None] = {}
        for task, came in self._events(sorted(tasks, key=_size, reverse=True)):
            begun[task] = came
            at = [each.sheet.stem for each, ended in begun.items() if ended is None]
            names = ", ".join(at[:NAMED] + ["..."] * (len(at) > NAMED))
            progress(f"{DOING[task.step]}, {len(begun) - len(at)} of {len(tasks)} done: {names}")
        return [came for task in tasks if (came := begun[task])]

    def _events(self, tasks: Sequence[Task]) -> Iterator[tuple[Task, Outcome | None]]:
        """Each task when it is begun, with None, and again with what came of it. Raises OSError."""
        waiting: SimpleQueue[Task] = SimpleQueue()
        for task in tasks:
            waiting.put(task)
        events: SimpleQueue[Event] = SimpleQueue()
        for _ in range(min(self.count, len(tasks))):
            Thread(target=self._work, args=(waiting, events), daemon=True).start()
        left = len(tasks)
        while left:
            try:
                task, came = events.get(timeout=OFTEN)
            except Empty:
                continue
            if isinstance(came, BaseException):
                raise came
            left -= came is not None
            yield task, came

    def _work(self, waiting: SimpleQueue[Task], events: SimpleQueue[Event]) -> None:
        while not self.closed:
            try:
                task = waiting.get_nowait()
            except Empty:
                return
            events.put((task, None))
            try:
                events.put((task, self._outcome(task)))
            except BaseException as error:  # told where it can be raised
                events.put((task, error))

    def _outcome(self, task: Task) -> Outcome:
        """Raises OSError."""
        try:
            worker = self.idle.pop()
        except IndexError:
            worker = _Worker(self.hello)
            self.all.append(worker)
        try:
            answer, memory = worker.ask(task)
        except (EOFError, BrokenPipeError, pickle.UnpicklingError):
            return Outcome(accident=SheetError(f"{task.sheet}: {worker.death()}", None, REPORT))
        if memory < LARGE:
            self.idle.append(worker)
        else:
            worker.end()
        if isinstance(answer, OSError):
            raise answer
        return answer


def _size(task: Task) -> int:
    try:
        return task.sheet.stat().st_size
    except OSError:
        return 0


class _Worker:
    """One process, which is asked one thing at a time."""

    def __init__(self, hello: bytes) -> None:
        # In a session of its own, where Ctrl-C does not reach it: who started it ends it.
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-c", START],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            start_new_session=True,
        )
        self.first = hello

    def ask(self, task: Task) -> tuple[Outcome | OSError, int]:
        """What it answers, and how much memory it has held. Raises EOFError where it died."""
        told, heard = self.process.stdin, self.process.stdout
        assert told is not None and heard is not None
        told.write(self.first + pickle.dumps(task))
        told.flush()
        self.first = b""
        answer: tuple[Outcome | OSError, int] = pickle.load(heard)
        return answer

    def death(self) -> str:
        """How it died."""
        code = self.process.wait()
        by = f"status {code}" if code >= 0 else f"signal {-code}"
        full = ", as it does where memory is full" if code == -KILLED else ""
        return f"the process that built this sheet ended with {by}{full}"

    def end(self) -> None:
        """Ends it, whatever it is at."""
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout):
            if pipe is not None:
                with suppress(OSError):  # what was not yet sent
                    pipe.close()
