"""Runs with trial weights: their file, readings and recordings."""
