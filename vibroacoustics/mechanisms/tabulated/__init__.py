"""A machine whose forces and moments stand in a file."""

from .machine import TabulatedMachine

__all__ = ["TabulatedMachine"]
