"""Programs that simulate a block diagram and compare it with its transfer function.

Begin at `model` (what a program needs to know), then `python_control` and `simulink`, one writer for each
program; `code` writes formulas in their languages.
"""
