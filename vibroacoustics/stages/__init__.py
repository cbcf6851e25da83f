"""The stages of a run: each is one file that names what it reads and what it gives.

A stage joins rooms that know nothing of each other; formulas belong to those rooms.
"""
