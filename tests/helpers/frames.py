"""A scroll compressor's frame with round numbers, for tests."""

from vibroacoustics.machine.frame import Frame
from vibroacoustics.machine.shell_structure import Joint

FILM = {"diameter_m": 0.025, "length_m": 0.02, "radial_clearance_m": 12e-6}
BASE = {
    "keys_on": "fixed-scroll",
    "radially_compliant": True,
    "axially_compliant": False,
    "wraps_height_m": 0.13,
    "lower_bearing_height_m": -0.12,
    "fixed_scroll": {"mass_kg": 2.5, "radius_m": 0.075, "thickness_m": 0.04, "height_m": 0.14},
    "bearing_housing": {"mass_kg": 4.0, "radius_m": 0.075, "thickness_m": 0.06, "height_m": 0.08},
    "orbiting_scroll": {
        "mass_kg": 1.25, "radius_m": 0.055, "thickness_m": 0.03, "height_m": 0.125,
    },
    "lower_bearing": {"mass_kg": 1.0, "radius_m": 0.075, "thickness_m": 0.02, "height_m": -0.12},
    "stator": {"mass_kg": 10.0, "radius_m": 0.07, "thickness_m": 0.08, "height_m": -0.02},
    "bolts": {
        "number": 4,
        "radius_m": 0.06,
        "height_m": 0.115,
        "lateral_stiffness_n_per_m": 1e8,
        "axial_stiffness_n_per_m": 5e8,
        "guide_stiffness_n_per_m": 1e6,
    },
    "thrust_face": {"radius_m": 0.045, "height_m": 0.112, "stiffness_n_per_m": 1e9},
    "tips": {"radius_m": 0.035, "height_m": 0.145, "stiffness_n_per_m": 1e9},
    "keys_radius_m": 0.055,
    "keys_stiffness_n_per_m": 1e8,
    "pin_stiffness_n_per_m": 1e8,
    "pin_load_n": 2960.0,
    "oil_viscosity_pa_s": 0.0045,
    "film_speed_rpm": 2900.0,
    "metal_loss_factor_ratio": 0.01,
    "pin_film": FILM,
    "main_film": FILM,
    "lower_film": FILM,
    "joint_loss_factor_ratio": 0.03,
    "contacts": {
        "weld_n_per_m": 1e9, "leg_n_per_m": 1e9, "seal_n_per_m": 0.0, "land_n_per_m": 1e9,
    },
    "legs": {"height_m": -0.12, "band_m": 0.012, "welds": 3, "spread_rad": 0.14},
}  # fmt: skip
"""All but `legs` are tables of numbers in SI."""


def frame_with(**changes: object) -> Frame:
    """The base frame with other values; a table's values change one by one."""
    values: dict[str, object] = {}
    for name, given in {**BASE, **changes}.items():
        base = BASE[name]
        joined = {**base, **given} if isinstance(base, dict) and isinstance(given, dict) else given
        values[name] = Joint.model_validate(joined) if name == "legs" else joined
    return Frame.model_validate(values)
