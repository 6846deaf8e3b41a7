"""The fastest motion of several axes along a path that is given. `fastest` finds it step by step, `told` is
the page, `checks` holds the motion to the path and its limits."""
