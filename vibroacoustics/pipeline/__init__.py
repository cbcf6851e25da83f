"""The jobs: sole owner of the order of stages."""

from .known_radiation import given_radiation
from .radiating import radiate
from .recording import analyse_orders
from .speed_map import speed_frequency_map
from .study import run
from .tracking import track_orders

__all__ = [
    "analyse_orders",
    "given_radiation",
    "radiate",
    "run",
    "speed_frequency_map",
    "track_orders",
]
