"""Figures of designs, by what they are of."""
