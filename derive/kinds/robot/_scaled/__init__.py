"""A motion of the joints made slower or faster as a whole, until the torques just keep their limits.
`planned` is the motion as it is given, `demands` what each joint needs of it, `told` what the page says,
`checks` holds all of it to the bodies."""
