r"""Published LaTeX read into trees: what keys of books and courses have, and what SymPy's printer writes.

Taken are sums, products side by side (`m g L_c c_{12}`), quotients, powers, roots, functions with parentheses
or without, matrices, names with scripts and dots, rates in Leibniz's form, and around all that labels, boxes,
chains a = b = c and definitions that follow (`statements`). What may mean something and is not understood is
an error with its place; nothing is dropped and nothing is run.

Begin at `parser.read_latex`: the tokens of a text go in, a tree comes out. The parser has a `Cursor` in the
tokens and hands it to its readers of `names`, `functions` and `matrices`.
"""
