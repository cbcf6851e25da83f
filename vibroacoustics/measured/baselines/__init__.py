"""Formats of measured baselines, one a module."""
