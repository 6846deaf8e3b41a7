"""A formula as it is set: boxes read from our LaTeX, written in the notation of a format.

What a formula says, in which order and on how many lines is decided once, in LaTeX, which is read back
before a page goes out. The other notations only spell it: `boxes` are what is set, `tex` reads them,
`typst` writes them. Begin with `boxes`.
"""
