"""Linear systems with one input and one output, exact: no floating point decides anything.

Begin at `system` (equations in s) and `elimination` (each signal in terms of the input, as a person does
it). From there `rational` has the transfer function, `controllers` the closed loop, `states` the state space,
`routh` and `hurwitz` stability, `roots` poles, `modes` and `response` the step response; `diagram` is a
block diagram as a value, `realisation` says how one is built, and `scripts/` writes programs to simulate it.
"""
