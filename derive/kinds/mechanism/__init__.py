"""The degrees of freedom of mechanisms, in `mobility`."""
