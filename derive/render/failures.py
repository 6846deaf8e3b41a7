"""What keeps a page from being made in one format; the others can be."""

from __future__ import annotations


class PageFailed(Exception):
    """A page could not be made; the message says why, `hint` what else there is."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message)
        self.hint = hint


class PandocFailed(PageFailed):
    """Pandoc could not read or write it; the message is what it said."""


class PdfFailed(PageFailed):
    """It could not be made into a PDF."""


class NoGlyphs(PdfFailed):
    """Characters that the fonts of the PDF do not have."""

    def __init__(self, characters: str) -> None:
        super().__init__(f"the fonts of the PDF do not have {characters}")
        self.characters = characters
