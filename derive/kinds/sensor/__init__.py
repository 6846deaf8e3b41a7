"""Encoders and switched voltages. Begin with `resolution`; `_encoder` has the lines that two kinds share."""
