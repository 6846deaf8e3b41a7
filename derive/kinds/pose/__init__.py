"""Kinds that ask about one pose, whatever the subject is: `_given` has the subject's folder say what its
pose is.

The angles of a sequence are found in `_euler_steps` and checked in `_euler_checks`; `_numbers` writes exact
angles and roots as a person does.
"""
