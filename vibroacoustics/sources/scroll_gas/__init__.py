"""Gas forces of a scroll compressor: wraps, pockets, pressures, forces, the thesis's program."""
