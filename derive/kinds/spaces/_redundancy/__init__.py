"""Joint rates where several give the same velocity: pseudo-inverses, null spaces, priorities, limits."""
