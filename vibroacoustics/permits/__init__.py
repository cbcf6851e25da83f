"""May a unit stand here: what authorities compute at a window, rule by rule, and their limits."""
