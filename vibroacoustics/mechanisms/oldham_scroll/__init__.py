"""The scroll with an Oldham coupling."""

from .machine import OldhamScroll

__all__ = ["OldhamScroll"]
