"""Published answers held against derived ones, entry by entry: equal, differs, or undecided.

`equal` is proved by the normal form, `differs` is shown at a point where both surely have other values, and
all else is undecided. A wrong answer is never called equal.

Begin at `checking.checks`: it reads what was typed (`typed`, `reading`, `chains`, `latex/`), compares scalars
(`comparing`, with `points`, `regions` and `rounding`) and sets of solutions (`branches`), and says what
probably went wrong (`diagnosing`). `asked` is the question with what there is to compare.
"""
