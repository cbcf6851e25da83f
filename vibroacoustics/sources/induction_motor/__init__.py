"""Induction motors: torque over slip, twice-line-frequency torque, answer to a load's ripple."""
