"""A motor behind a gear: reflected inertia, and the gear that accelerates the load most."""
