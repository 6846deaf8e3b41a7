"""Workspaces: `regions` finds their borders, `checks` searches for points beyond them."""
