"""Criteria that are computed from the results, one file each."""
