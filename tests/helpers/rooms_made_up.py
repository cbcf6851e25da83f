"""A machine in a room whose vectors are made up: alike at all listeners and all positions."""

import numpy as np
import xarray as xr

from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS, stamp

RADIUS_M = 1.1
TO_EARS_S = 0.01
"""Of the sound of a plate, whose Green's function has an amplitude of 1/m."""
HIGHEST_HZ = 800.0
KITCHEN = {
    "size_mm": [4000.0, 3000.0, 2500.0],
    "foot_mm": [3500.0, 400.0],
    "maximum_frequency_hz": HIGHEST_HZ,
    "walls": {"floor": "tiles", "-x": "plaster", "ceiling": "acoustic_ceiling"},
    "furniture": {
        "cupboard": {
            "lower_mm": [0.0, 0.0, 0.0],
            "upper_mm": [1000.0, 600.0, 2000.0],
            "material": "boards",
        }
    },
    "listeners": {
        "table": {"x_mm": 2000.0, "y_mm": 2200.0, "height_mm": 1200.0},
        "doorway": {"x_mm": 500.0, "y_mm": 2500.0, "height_mm": 1600.0},
    },
    "limits": {"day_dba": 60.0, "night_dba": 30.0},
}


def made_up_vectors(listeners, motions=(), room=1.0, open_=1.0, highest_hz=4000.0):
    """Pressure per velocity that grows with frequency, of every pattern alike."""
    patterns = [*RIGID_BODY_DOFS, *(motion.name for motion in motions)]
    fine, table = np.arange(1.0, 840.0), np.arange(25.0, highest_hz + 1.0, 25.0)
    waves = room * 0.01j * fine * np.ones((len(listeners), len(patterns), 1))
    hemisphere = open_ * 0.01j * table * np.ones((20, len(patterns), 1))
    return xr.Dataset(
        {
            "room_transfer_vector": stamp(
                "room_transfer_vector",
                waves,
                {"listener": list(listeners), "pattern": patterns, "room_frequency": fine},
            ),
            "room_green_of_foot": stamp(
                "room_green_of_foot",
                room * np.exp(-2j * np.pi * fine * TO_EARS_S) * np.ones((len(listeners), 1)),
                {"listener": list(listeners), "room_frequency": fine},
            ),
            "hemisphere_transfer_vector": stamp(
                "hemisphere_transfer_vector",
                hemisphere,
                {
                    "hemisphere_position": np.arange(1, 21),
                    "pattern": patterns,
                    "frequency": table,
                },
            ),
        },
        attrs={
            "hemisphere_radius_m": RADIUS_M,
            "room_maximum_frequency_hz": HIGHEST_HZ,
            "room_record_s": 0.5,
        },
    )
