"""What the author of a kind imports, in one line: the board, the trees, the normal form, claims and options.

A kind is a module with `RESULTS`, `EXAMPLE`, `class Options(OptionsModel)` and `derive(subject, options,
problem)`, and a file of words of the same name in `templates/words/`. CONTRIBUTING.md shows one from end to
end.
"""

__all__ = [name for name in dir() if name[0] != "_"]
