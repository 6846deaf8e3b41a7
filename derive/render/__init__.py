"""Derivations as pages: every LaTeX, and every decision about what a page has room for, is made here.

Begin with `page`, which goes through a document, and `words`, which tells one derivation by the templates of
its kind. `latex` prints a tree, `width` measures it, `layout` breaks it, `entries` names what is too wide and
`room` leaves out what is too long. `skin` is the look of a format; `pdf`, `web` and `figures` write files.
"""
