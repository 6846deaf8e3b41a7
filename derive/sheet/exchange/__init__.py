"""Robots of other programs, read: URDF and xacro, tables of rows or screws in CSV; and written, as URDF.

To read, begin in `files.py`: a file becomes the data that a robot's YAML would hold, each part with its
place in the file it came from, so that later faults point there. `told.py` writes the same data down as
YAML. To write, begin in `to_urdf.py`.
"""
