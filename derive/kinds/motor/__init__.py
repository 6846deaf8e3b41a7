"""Kinds of motors alone; those of every linear system stand in `system` and answer for motors too."""
