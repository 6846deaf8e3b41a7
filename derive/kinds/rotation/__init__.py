"""Kinds that ask about a rotation matrix given as such: those of any pose, and how fast it turns."""
