"""The mechanics of rigid bodies as books have it: what a sheet gives, and formulas on it. No pages, no words.

What a sheet gives is a frozen value (`robot`, `frames`, `motion`, `bodies`, `lagrangian`, `profile`, ...).
Of an arm begin at `dh` (rows as motions), `poses` and `chain` (the arm in one ring), then `jacobian`,
`dynamics` and `newton_euler`; singular sets are in `singular`, `strata` and `vanishing`, inverse kinematics
in `inverse/`. `oracle` is the second route: the same answers in plain numbers, by other formulas.
"""
