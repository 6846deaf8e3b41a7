"""Arms as tables of link parameters and as chains of screws: `dh_rows` is a table with its proof,
`dh_found` the frames of a convention assigned to joint axes, `exponentials` the pose as a product of
exponentials, `by_rows` an arm of screws answered by its rows."""
