"""The program `derive`: what is heavy is imported once the standard streams and Ctrl-C are looked after."""

from __future__ import annotations

import gc
import os
import sys


def main() -> None:
    """Runs the command line."""
    try:
        _open_streams()
        keep_to_one_thread()
        from derive.cli import main as command

        command()
    except KeyboardInterrupt:
        os.write(2, b"Aborted!\n")
        sys.exit(1)
    finally:
        gc.freeze()  # the process ends: what is left need not be searched for cycles


def keep_to_one_thread() -> None:
    """NumPy's matrices are small here: more threads would but wait for each other, and take the processors
    from the sheets that are built at the same time."""
    for library in ("OPENBLAS", "MKL"):
        os.environ.setdefault(f"{library}_NUM_THREADS", "1")


def _open_streams() -> None:
    """Streams that are closed lead nowhere; else the first file that is opened would be one of them."""
    for number, name, mode in ((0, "stdin", "r"), (1, "stdout", "w"), (2, "stderr", "w")):
        try:
            os.fstat(number)
        except OSError:
            nowhere = os.open(os.devnull, os.O_RDWR)
            if nowhere != number:
                os.dup2(nowhere, number)
                os.close(nowhere)
            setattr(sys, name, os.fdopen(number, mode, closefd=False))


if __name__ == "__main__":
    main()
