"""The report: what finished results say, as pages, tables, text and JSON.

The functions are imported when they are first asked for: a page needs few of them.
"""

from ..base.lazy import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
