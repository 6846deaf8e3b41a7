"""The auditors, subject by subject."""
