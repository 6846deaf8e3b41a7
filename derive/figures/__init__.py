"""Every drawing, as data: strokes, captions and curves in plain numbers. `render/` puts them on paper.

Begin at `view` (how space is seen), then `arm` (a robot in one pose), `poses` (which pose shows it) and
`arm_sketch` (what is drawn of it); `held` compares that with the oracle, `described` says it in words.
`elbows` and `singular_poses` belong to answers about planar arms. `triads` draws frames, `bodies` what they
stand on, `motions` a motion step by step, `loops` a system: `block_diagram` says which blocks and lines,
`block_layout` where they are, `block_wires` how lines run. `courses`, `responses`, `ellipses`, `workspaces`
and `waves` are plots. Symbols have typical values (`typical`), or those that an author wishes for (`wish`):
a figure shows a subject, it proves nothing.
"""
