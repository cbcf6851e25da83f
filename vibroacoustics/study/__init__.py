"""From a study file to a `Study`: settings, reading, units, ranges, refusals."""
