"""Sheets of a robotics course turned into worked, verified solution sheets.

Begin with `build` (sheets in, documents out); docs/design.md names the nine files of the heart.
"""
