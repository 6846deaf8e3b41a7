"""Words of other courses, books and tools for what the language calls otherwise: points are marks, r is a."""

from __future__ import annotations

from collections.abc import Collection

OURS = {
    "marks": "points pts score credits grade",
    "text": "question prompt statement description",
    "answer": "solution key expected published",
    "find": "ask asks kind type want wanted compute derive determine calculate",
    "evaluate": "value values numbers numeric",
    "where": "let define definitions abbreviations",
    "symbols": "assume assumptions",
    "problems": "exercises tasks",
    "robot": "arm manipulator",
    "links": "dh rows table dh-table joints",
    "a": "r length",
    "alpha": "twist",
    "d": "offset",
    "mass": "m weight",
    "com": "cog cm center-of-mass centre-of-mass center centre",
    "range": "limit limits",
    "gravity": "g",
    "forward-kinematics": "fk direct-kinematics",
    "inverse-kinematics": "ik",
    "dynamics": "equations-of-motion lagrange euler-lagrange",
    "equations-of-motion": "dynamics euler-lagrange",
    "inertia-matrix": "mass-matrix",
    "singularities": "singular-configurations",
}


def our_word(typed: str, known: Collection[str]) -> str:
    """The known name for which others say what was typed; "" where there is none."""
    word = typed.lower().replace("_", "-").replace(" ", "-")
    return next((name for name, others in OURS.items() if name in known and word in others.split()), "")
