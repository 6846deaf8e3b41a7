"""Inverse kinematics in closed form, written as a person works it.

A plan (`derive/mechanics/inverse/plan.py`) becomes a page in this order. `open_chain` begins: what the author
`given`s is the goal, `refused` says why there is no closed form. `stages` goes through the plan, arm before
wrist, and hands each sub-problem to `solving`: `one_equation`, `two_equations` and `sums_of_squares` write
its equations and its values, and `progress` keeps the names, signs and sums that are known since. A solved
sub-problem (`subproblem`) has one or several values; a choice at each is a branch (`branches`). `checks` puts
every branch back through the forward kinematics; `evaluated` has the branches at the pose an author asks for,
each once, and what is free where the arm is singular there (`at_pose`, `distinct`). `working` reads the whole
for the page. The planar arm of two links is solved by its triangle instead (`two_link`), and six joints that
no formula inverts `by_elimination`, in numbers.
docs/inverse-kinematics.md derives one arm through all this.
"""
