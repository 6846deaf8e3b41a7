"""How a body turns while it goes along a path. `course` begins, with both orientations and the share of the
way; `one_axis`, `quaternions` and `angles` are the ways from one to the other, `told` puts them on the board,
`checks` holds each in numbers."""
