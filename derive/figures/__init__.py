"""Every drawing, as data: strokes, captions and curves in plain numbers. `render/` puts them on paper.

Begin at `view` (how space is seen), then `arm` (a robot in one pose) and `arm_sketch` (what is drawn of it).
`triads` draws frames and motions, `loops` a system: `block_diagram` says which blocks and lines,
`block_layout` where they are, `block_wires` how lines run. `courses`, `responses`, `ellipses`, `workspaces`
and `waves` are plots. Symbols have typical values (`typical`): a figure shows a subject, it proves nothing.
"""
