"""Magnetic forces across a motor's air gap: Maxwell's stress of its waves of flux."""
