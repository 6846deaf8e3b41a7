"""Frames given one in the other. Begin with `transforms`; `_frames` has the names and the local poses."""
