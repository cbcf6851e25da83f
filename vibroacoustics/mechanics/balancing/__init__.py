"""Balancing by influence coefficients: plain functions on arrays."""
