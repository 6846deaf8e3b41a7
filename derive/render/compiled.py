"""Templates as a process before compiled them, in the folder of the user for such things.

What lies there is told apart by the text of its template; what cannot be read or written is compiled.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from pickle import UnpicklingError
from stat import S_IRWXU, S_ISDIR, S_IWGRP, S_IWOTH
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
OTHERS = S_IWGRP | S_IWOTH


class Compiled(FileSystemBytecodeCache):
    """One file for each template, in a folder that no one else can write to: what lies there is run."""

    def load_bytecode(self, bucket: Bucket) -> None:
        """What lies there, if it is of this template."""
        with suppress(*UNREADABLE):
            if self._is_ours():
                super().load_bytecode(bucket)

    def _is_ours(self) -> bool:
        found = Path(self.directory).lstat()
        own = not hasattr(os, "getuid") or (found.st_uid == os.getuid() and not found.st_mode & OTHERS)
        return S_ISDIR(found.st_mode) and own

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Kept for the next process, where that can be."""
        with suppress(OSError):
            Path(self.directory).mkdir(mode=S_IRWXU, parents=True, exist_ok=True)
            if self._is_ours():
                super().dump_bytecode(bucket)


def compiled_before(environment: Environment) -> Compiled | None:
    """Those of an environment that compiles as this one does; None where there is no such folder."""
    place = folder()
    ways = environment.trim_blocks, environment.lstrip_blocks, environment.keep_trailing_newline
    pattern = f"%s-{crc32(repr((ways, sorted(environment.filters), sorted(environment.tests))).encode()):08x}"
    return Compiled(str(place / "templates"), pattern) if place else None
