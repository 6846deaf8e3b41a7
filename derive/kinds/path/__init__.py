"""Paths of a point: their tangents, curvature and length, and the motion along them."""
