"""What an author types, read into trees: `m_1 L^2/3`, `30 deg`, `0.1 m`. Parsed, never run as code.

The pipeline: `tokens` (words with their places) -> `cursor` -> `grammar` (a Pratt parser; begin here) ->
`quantities` (trees with their dimensions and sizes). `units` and `unit_phrases` say when a letter is a unit,
`functions` which functions there are, `undefined` which numbers are none, and `likely_mistakes` what was
probably not meant.
"""
