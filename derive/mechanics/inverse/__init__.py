"""Inverse kinematics of an open chain in closed form: which sub-problems solve it, and in which order.

Begin with `plan`: it decouples an arm with a spherical wrist (`wrist`, after Pieper 1968) and asks `search`
for one sub-problem after the other. What is given of the end-effector is a `goal`; the equations are Paul's
(`paul`, after Paul 1981, chapter 3), read in what is `known` by then; the forms in which an equation can be
solved for one joint variable are the `subproblems`, and `two_slides`, `doubled` and `pieper` join several
where none is. Nothing here is written down or chosen by an arm's name; that is for
`derive/kinds/robot/_inverse`.
docs/inverse-kinematics.md derives one arm through both folders.

Where there is no plan, `raghavan_roth` finds all solutions at one pose in numbers.
"""
