"""The opening of the thesis's scroll at operating points with R410A."""

import numpy as np

from vibroacoustics.sources.scroll_gas.parameters import ScrollGas, ScrollOpening, ScrollWraps

SPEED_RPM = 2900.0
WRAPS = ScrollWraps(
    base_radius_m=2.15e-3,
    height_m=0.03,
    thickness_m=3.293e-3,
    start_angle_rad=np.pi / 3.0,
    turns=3.0,
    closing_crank_angle_rad=0.5 * np.pi,
)
OPENING = ScrollOpening(
    gap_length_m=4e-3,
    port_length_m=20e-3,
    port_diameter_m=12e-3,
    discharge_coefficient_ratio=1.0,
    chamber_volume_m3=2.5e-6,
    plenum_volume_m3=0.7e-3,
    tube_diameter_m=10.7e-3,
)
POINTS = {
    "thesis": (15.0, 41.159, 1.1558, 172.0, 143.0),
    "ari": (9.98, 33.86, 1.067, 178.0, 112.0),
    "en_5_50": (9.33, 30.63, 1.072, 178.0, 101.0),
    "heating_m5_50": (6.78, 30.63, 1.083, 178.0, 100.0),
}
"""Suction and discharge in bar, polytropic index, speed of sound in m/s and density in kg/m³."""


def gas_at(point: str) -> ScrollGas:
    """The gas of an operating point, which opens with inertia."""
    suction, discharge, index, sound, density = POINTS[point]
    return ScrollGas(
        suction_pressure_pa=1e5 * suction,
        discharge_pressure_pa=1e5 * discharge,
        polytropic_index=index,
        opening_law="inertia",
        discharge_density_kg_per_m3=density,
        discharge_sound_speed_m_per_s=sound,
    )


GAS = gas_at("ari")
