"""The jobs on a study: sole owner of the order of stages."""

from .machines import run_machines
from .radiating import radiate
from .room_responses import impulse_responses
from .study import run

__all__ = ["impulse_responses", "radiate", "run", "run_machines"]
