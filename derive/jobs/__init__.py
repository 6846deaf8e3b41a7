"""The sheets of one command: each is read, derived and made into pages by itself, here or in another process.

Begin with `run`: what is built, in which order faults are told, and when pages are put in their place. `one`
is the work on one sheet; `workers` are the processes, of which `worker` is the other end.
"""
