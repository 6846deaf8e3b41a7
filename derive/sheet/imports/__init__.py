"""Robots written for other programs: URDF and xacro, tables of rows or screws in CSV.

Begin in `files.py`: a file becomes the data that a robot's YAML would hold, each part with its place in the file it
came from, so that every later fault points there. `written.py` writes the same data down as YAML.
"""
