"""The jobs on a study: sole owner of the order of stages."""

from .radiating import radiate
from .room_responses import impulse_responses
from .study import run

__all__ = ["impulse_responses", "radiate", "run"]
