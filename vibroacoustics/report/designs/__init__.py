"""The report of many designs: their front, what decides, and the best few against none."""
