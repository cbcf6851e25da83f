"""The jobs: sole owner of the order of stages."""

from .radiating import radiate
from .study import run

__all__ = ["radiate", "run"]
