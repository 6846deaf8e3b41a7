"""Programs that simulate a block diagram and compare it with its transfer function.

Begin at `programs`: what a program needs to know, and one writer for each language. What every program of a
language has stands in the texts beside it; `code` writes formulas in their languages.
"""
