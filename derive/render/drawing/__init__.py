"""Pictures on paper: from the data of `figures/` to SVG, PDF and PNG, drawn by Typst's own compiler.

Begin at `style` (what every picture looks like), then `paper` (strokes and letters in points, written to
files), `lettering` (what is written, and how much room it takes) and `placing` (where captions go so that
none lies on another or on a line). `subjects` puts a drawing together.
"""
