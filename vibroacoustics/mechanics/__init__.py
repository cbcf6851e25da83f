"""Motions that machine kinds and balancers share."""
