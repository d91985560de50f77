"""How fast: ratios made in one run, so that they mean the same on every machine."""
