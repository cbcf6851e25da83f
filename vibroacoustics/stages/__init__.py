"""The stages of a run: each names what it reads and what it gives.

A stage joins rooms that know nothing of each other; formulas belong to those rooms.
"""
