"""Functions of several variables: derivatives, and extreme values with and without constraints.

Begin with `gradient`; `_stationary` looks for the points, `_worked` writes them down.
"""
