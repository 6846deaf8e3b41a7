"""Pictures on paper: from the data of `figures/` to SVG, PDF and PNG, drawn by Typst's own compiler.

Begin at `style` (what every picture looks like), then `paper` (strokes and letters in points, written to
files), `lettering` (what is written, and how much room it takes) and `placing` (where captions go so that
none lies on another or on a line). `subjects` puts a drawing together, `plots` a plot: `axes` with their
ticks, `curves` and what is read off them (`readings`), the `legend`; a `sketch` is what is drawn before the
size of the paper is known.
"""
