"""The jobs: sole owner of the order of stages.

They are imported when they are first asked for: one on a recording needs no radiation.
"""

from typing import TYPE_CHECKING, Any

from ..base.lazy import imported

if TYPE_CHECKING:
    from .measured_power import sound_power
    from .measurement_surface import MeasurementSurface
    from .radiating import radiate
    from .recording import analyse_orders, speed_frequency_map, track_orders
    from .room_responses import impulse_responses
    from .study import run

__all__ = [
    "MeasurementSurface",
    "analyse_orders",
    "impulse_responses",
    "radiate",
    "run",
    "sound_power",
    "speed_frequency_map",
    "track_orders",
]

_HOME = {
    "MeasurementSurface": "measurement_surface",
    "analyse_orders": "recording",
    "impulse_responses": "room_responses",
    "radiate": "radiating",
    "run": "study",
    "sound_power": "measured_power",
    "speed_frequency_map": "recording",
    "track_orders": "recording",
}


def __getattr__(name: str) -> Any:
    """Import a job when it is first asked for."""
    return imported(__name__, _HOME, name)
