"""Studies from file to `Study`: settings, reading, units, ranges, refusals."""
