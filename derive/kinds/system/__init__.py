"""Linear systems and motors: transfer functions, loops, stability, states, step responses.

Begin with `transfer_function`; `_plant` is what the kinds share: the system solved, its names, its numbers.
"""
