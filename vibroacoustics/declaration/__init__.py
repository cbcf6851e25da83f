"""The data sheet of an option: what a maker states of a machine, predicted."""
