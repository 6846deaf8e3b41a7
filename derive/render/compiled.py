"""Templates as a process before compiled them, in the folder of the user for such things.

What lies there is told apart by the text of its template; what cannot be read or written is compiled.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from pickle import UnpicklingError
from zlib import crc32

from jinja2 import Environment, FileSystemBytecodeCache
from jinja2.bccache import Bucket

from derive.known.stamps import folder

UNREADABLE = (
    OSError,
    EOFError,
    ValueError,
    TypeError,
    AttributeError,
    ImportError,
    IndexError,
    UnpicklingError,
)


class Compiled(FileSystemBytecodeCache):
    """One file for each template."""

    def load_bytecode(self, bucket: Bucket) -> None:
        """What lies there, if it is of this template."""
        with suppress(*UNREADABLE):
            super().load_bytecode(bucket)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Kept for the next process, where that can be."""
        with suppress(OSError):
            Path(self.directory).mkdir(parents=True, exist_ok=True)
            super().dump_bytecode(bucket)


def compiled_before(environment: Environment) -> Compiled | None:
    """Those of an environment that compiles as this one does; None where there is no such folder."""
    place = folder()
    ways = environment.trim_blocks, environment.lstrip_blocks, environment.keep_trailing_newline
    pattern = f"%s-{crc32(repr((ways, sorted(environment.filters), sorted(environment.tests))).encode()):08x}"
    return Compiled(str(place / "templates"), pattern) if place else None
