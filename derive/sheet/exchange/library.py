"""Files that a description includes: beside it, or in a ROS package around it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from derive.known.files import lies_below, noted

INCLUDED = (".xacro", ".urdf", ".xml")


@dataclass(frozen=True, slots=True)
class Library:
    """`packages` that stand elsewhere, by name, and the `folder` that no file may leave; None lets them."""

    packages: Mapping[str, Path] = field(default_factory=dict)
    folder: Path | None = None

    def file(self, here: Path, name: str, package: str = "") -> Path | None:
        """A file by its path from a folder, or from that of a package; None where there is none."""
        folders = self._folders(here.resolve(), package) if package else [here]
        return next(filter(self._may_be_read, (folder / name for folder in folders)), None)

    def _folders(self, here: Path, package: str) -> Iterator[Path]:
        """Those a package may be: the one named, one around this folder, or one beside a folder around it."""
        if package in self.packages:
            yield self.packages[package]
        for around in (here, *here.parents):
            if around.name == package:
                yield around
            yield around / package

    def _may_be_read(self, path: Path) -> bool:
        noted(path)
        inside = self.folder is None or lies_below(path, self.folder)
        return inside and path.suffix.lower() in INCLUDED and path.is_file()
