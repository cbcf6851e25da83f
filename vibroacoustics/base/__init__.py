"""Foundations of all other packages: arrays, units, files, vocabulary, registry."""
