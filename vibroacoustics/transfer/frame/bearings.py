"""Pin, main and lower bearing: oil film and metal in series between shaft and parts."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array, ComplexArray
from ...base.units import shaft_frequency_hz
from ...machine.frame import (
    BEARING_HOUSING,
    LOWER_BEARING,
    ORBITING_SCROLL,
    Frame,
    Part,
    PlainBearing,
)
from ...mechanics.critical_speed import FreeShaft
from ...mechanics.journal_film import JournalFilm, short_bearing


@dataclass(frozen=True)
class Bearing:
    """A bearing of the shaft.

    Attributes
    ----------
    part : that carries the shaft here or that the shaft carries
    node : node of the shaft
    film : film of oil
    metal_stiffness : in series, with loss, N/m
    """

    part: Part
    node: int
    film: JournalFilm
    metal_stiffness: complex

    def flexibility(self, omega: Array) -> ComplexArray:
        """Flexibility along x and along y, shape (frequency,), m/N.

        Parameters
        ----------
        omega : shape (frequency,), rad/s
        """
        return self.film.flexibility(self.metal_stiffness, omega)


def bearings_of(frame: Frame, shaft: FreeShaft) -> tuple[Bearing, ...]:
    """Pin, main and lower bearing; the pin's load on two journals by the lever."""
    speed = 2.0 * np.pi * shaft_frequency_hz(frame.film_speed_rpm)
    pin_height, main_height = shaft.heights_m[[shaft.pin_node, shaft.main_node]]
    lever = float(pin_height / main_height)
    lossy = 1.0 + 1j * frame.metal_loss_factor_ratio

    def bearing(
        part: Part, node: int, size: PlainBearing, share: float, stiffness_n_per_m: float
    ) -> Bearing:
        film = short_bearing(
            size.diameter_m, size.length_m, size.radial_clearance_m,
            frame.oil_viscosity_pa_s, speed, share * frame.pin_load_n,
        )  # fmt: skip
        return Bearing(part, node, film, stiffness_n_per_m * lossy)

    journals = shaft.bearing_stiffness_n_per_m
    return (
        bearing(ORBITING_SCROLL, shaft.pin_node, frame.pin_film, 1.0, frame.pin_stiffness_n_per_m),
        bearing(BEARING_HOUSING, shaft.main_node, frame.main_film, lever, journals),
        bearing(LOWER_BEARING, 0, frame.lower_film, lever - 1.0, journals),
    )
