"""Uncertain parameters: ranges, and samples of values from them."""
