"""The jobs: sole owner of the order of stages.

They are imported when they are first asked for: one on a recording needs no radiation.
"""

from ..base.lazy import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
