"""Rolling-piston compressor with one or two cylinders: gas, vane, roller, drive."""

from .machine import RollingPistonMachine

__all__ = ["RollingPistonMachine"]
