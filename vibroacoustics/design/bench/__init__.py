"""Balancing of a machine on the bench: answers from runs with trial weights."""
