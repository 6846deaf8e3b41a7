"""Mistakes planted into the code and the words, one at a time: does a plain build print any of them?

`python -m tests.mutants` draws places by a seed, plants there, builds problems that reach the place, and
reports what came out wrong; `python -m tests.mutants lines` turns one sign in one printed line, and
`sentences` and `tables` in place of `lines` one there. Begin at `operators.py` (what is planted) and
`trial.py` (what becomes of it), or at `said.py`.
"""
