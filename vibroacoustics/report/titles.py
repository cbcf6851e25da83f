"""Titles of results, for figures."""

from ..results.titles import chosen, titled

__all__ = ["chosen", "titled"]
