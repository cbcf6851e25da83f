"""Jeffcott's rotor: what the thesis takes for a sag is a deflection under centrifugal force."""

from vibroacoustics.base.arrays import Array


def unbalance_deflection_m(
    eccentricity_m: float, speed: Array | float, critical_speed: float
) -> Array | float:
    """Deflection of a disc on a light shaft, y = e ω²/(ω_c² - ω²) (Jeffcott 1919).

    Parameters
    ----------
    eccentricity_m : e of the disc's centre of mass
    speed, critical_speed : in the same unit
    """
    return eccentricity_m * speed**2 / (critical_speed**2 - speed**2)
