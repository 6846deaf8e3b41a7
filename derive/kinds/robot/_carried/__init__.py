"""The end-effector carried along a path, and the joints that carry it. `setting` begins: an arm, a path, what
is known in numbers; `coordinates` says which rows of the arm the path is about; `closed` is the answer, with
the joints as they are `followed`; `sampled` draws what is found over time, `checks` holds it to the arm."""
