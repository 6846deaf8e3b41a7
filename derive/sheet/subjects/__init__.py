"""The subjects of problems, one module each, found by name.

A subject module has `Given`, the pydantic type of what the author writes under its key, and
`build(given, at, known)`, which gives the frozen value the kinds work on or raises SheetErrors.
It may have `missing(subject, need, at)`: the faults where a kind's `NEEDS` are not met.
"""
