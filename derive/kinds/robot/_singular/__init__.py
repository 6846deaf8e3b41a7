"""Singular configurations: where a Jacobian loses rank, what the arm looks like there, and what it cannot do.

`ways` finds the sets in one of three ways (the determinant, its split at a wrist, all minors of full size),
`sets` analyses each: its values (`values`), the rank and the null spaces; `geometry` names what is seen in
numbers (an elbow stretched, axes that coincide) and `saying` puts it into phrases, `facts` into what the
words read; `checks` looks at the ranks in numbers. The search itself is in `derive/mechanics`: `singular`,
`vanishing` (by the sub-problems of `zeros`), `strata` (the rank on each set) and `sampling`.
"""
