"""Closed forms of options, one file each."""
