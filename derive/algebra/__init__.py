"""Exact algebra: a normal form in which equality is `==`, and the way back to what a person would write.

A normal form is a unique way of writing an expression: two expressions are equal exactly when theirs are the
same. Here it is a polynomial over the rationals in the letters, in a pair (cosine, sine) for each angle with
s^2 = 1 - c^2, and in roots, or a quotient of two such polynomials. No simplifier is called anywhere.

Begin with `ring` (the generators and what they obey), then `scalar` and `matrix` (arithmetic), then `normal`
(from a tree to its value, by one walk). Below them: `generators`, `angles`, `multivariate` (FLINT's
polynomials). Between them, from the ground up: `fixed_angles` (is a number zero?), `calculus`,
`exact_values`, `roots_and_functions`, `trigonometry`, `powers`, `substitution`, `signs`.

    formulas   what an author types, read into trees
    normal     a tree -> its normal form
    readable   a normal form -> a short tree
    numbers    trees and normal forms as floats and balls
    solving    factors, roots, ranks, systems of polynomial equations
    fold       one walk of a tree for every domain of values, as `evaluation` is of normal forms;
               `infix` prints a tree, `interop` is the door to SymPy
"""
