"""A sheet from its file: what stands where, what it means, and every fault in it at its line and column.

Begin at `load.load_sheet`. `reader` gives plain data with places (`source`), `checked` brings it into the
models of `given` and of `subjects/`, `faults` retells what does not fit, and `model` is what comes out. Most
other modules look for one sort of fault; `doubts`, `unused` and `body_faults` also warn.
"""
