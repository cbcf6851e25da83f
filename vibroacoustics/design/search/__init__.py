"""Searches for designs: the best one, a front of several objectives."""
