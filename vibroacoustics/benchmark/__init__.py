"""Answers of this package to the open benchmark, one file for each field."""
