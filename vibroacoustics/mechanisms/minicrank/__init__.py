"""Scroll with mini-crank (Zhao et al.): four-bar linkage with link-length errors, input torque."""

from .machine import MiniCrankMachine

__all__ = ["MiniCrankMachine"]
