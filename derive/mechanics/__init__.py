"""The mechanics of rigid bodies as books have it: values of the sheet, and formulas on them. No pages, no words.

What a sheet gives is a frozen value (`robot`, `frames`, `motion`, `bodies`, `lagrangian`, `profile`, ...). Of
an arm begin at `dh` (rows as motions), `poses` and `chain` (the arm in one ring), then `jacobian`, `dynamics`
and `newton_euler`; singular sets are in `singular`, `strata` and `vanishing`, inverse kinematics in `inverse/`.
`oracle` is the second route: the same answers in plain numbers, by other formulas.
"""
