"""What the truths cost: their share of a build of all exercises to Markdown, by samples of where it is.

A sampler looks at the stack every millisecond of processor time, and counts the outermost frame that belongs
to a truth; a profiler that follows every call would take most from those that call much.
"""

from __future__ import annotations

import re
import signal
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType

ROOT = Path(__file__).parent.parent
EVERY = 0.001  # seconds of processor time
TRUTHS = {  # by file and function, from the outermost frame inwards
    "every line follows": r"/kinds/links\.py:",
    "as written": r"/readable/form\.py:as_written",
    "results are lines": r"/kinds/(told|declared)\.py:",
    "certain digits": r"/(evaluated_again|sure)\.py:",
    "sentences": r"/quoted\.py:",
    "the page read back": r"/read_back\.py:",
    "laws and second routes": r"/(\w*checks|\w*oracle|\w*meanings|repeated)\.py:|/oracle/|"
    r":(agrees|agreement|law|route|\w*claims)$",
}
PATTERNS = {truth: re.compile(pattern) for truth, pattern in TRUTHS.items()}
NONE = ""


def truth_shares(say: Callable[[str], None]) -> dict[str, float]:
    """The share of each truth in the time that it takes to build every exercise."""
    from derive.__main__ import keep_to_one_thread

    keep_to_one_thread()  # as the command does, before NumPy is imported
    from derive.build import derive_all
    from derive.sheet.load import load_sheet
    from derive.writing import render

    seen: Counter[str] = Counter()
    for sheet in sorted((ROOT / "exercises").glob("*.yaml")):
        say(f"truths of {sheet.stem}")
        with _sampled(seen):
            (document,) = derive_all([load_sheet(sheet)], True, lambda _: None)
            render(document, "md")
    return {truth: seen[truth] / seen.total() for truth in TRUTHS}


@contextmanager
def _sampled(seen: Counter[str]) -> Iterator[None]:
    def look(_: int, frame: FrameType | None) -> None:
        seen[_truth_of(frame)] += 1

    before = signal.signal(signal.SIGPROF, look)
    signal.setitimer(signal.ITIMER_PROF, EVERY, EVERY)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)


def _truth_of(frame: FrameType | None) -> str:
    places = []
    while frame is not None:
        places.append(f"{frame.f_code.co_filename}:{frame.f_code.co_name}")
        frame = frame.f_back
    for place in reversed(places):
        if place.startswith(str(ROOT / "derive")):
            for truth, pattern in PATTERNS.items():
                if pattern.search(place):
                    return truth
    return NONE


if __name__ == "__main__":
    shares = truth_shares(lambda _: None)
    for truth, share in {**shares, "all": sum(shares.values())}.items():
        print(f"{truth:24} {share:6.1%}")
