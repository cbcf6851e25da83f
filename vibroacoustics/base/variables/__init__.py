"""The built-in variables of results and their coordinates, by subject."""
