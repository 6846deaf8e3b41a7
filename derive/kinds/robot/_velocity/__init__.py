"""What is asked about some rows of a Jacobian. `task` begins: the rows, and the board that every such kind
starts from; `solving` and `splitting` find joint rates, `ellipsoids` how evenly an arm moves, `analytic`
the rates of Euler angles."""
