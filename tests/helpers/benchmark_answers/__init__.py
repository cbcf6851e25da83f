"""Answers of the package to the open benchmark, one file for each field."""
