"""What answers about systems are held to: numbers by routes of their own.

Equations solved in complex numbers (`equations`), motors as impedances and powers (`motor`), Laplace
transforms inverted in numbers (`inversion`), figures read off a curve (`figures`), roots by NumPy
(`poles`), scripts read as text (`scripts`). Nothing here knows how an answer was found: a contract in
pyproject.toml forbids it."""
