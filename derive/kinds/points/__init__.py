"""Transforms fitted to points. Begin with `fit_transform`; `_svd` and `_rows` are its two methods."""
