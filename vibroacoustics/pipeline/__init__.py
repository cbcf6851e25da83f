"""The jobs: sole owner of the order of stages."""

from .radiating import radiate
from .recording import analyse_orders, speed_frequency_map, track_orders
from .study import run

__all__ = [
    "analyse_orders",
    "radiate",
    "run",
    "speed_frequency_map",
    "track_orders",
]
