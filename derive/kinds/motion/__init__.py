"""Kinds of motions, sequences of turns and shifts about world and current axes. Begin with `_product`: the
factors (`_factors`), each by itself, and their product in the order that the axes command."""
