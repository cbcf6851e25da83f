"""Isentropic flow of a gas through a nozzle."""

from typing import Final

import numba
import numpy as np

ALMOST: Final = 1e-12
"""Value of κ - 1 below which a gas counts as isothermal."""


@numba.njit(cache=True, nogil=True, error_model="numpy")
def nozzle_flow(
    inner_pa: float, outer_pa: float, inner: float, outer: float, kappa: float
) -> float:
    """Isentropic flow through a nozzle, kg/(s m²); negative inwards.

    m/A = ρ x √(2 κ/(κ-1) p/ρ (1 - r/x)), x = r^(1/κ), with p and ρ upstream and the pressure ratio
    r no lower than the critical (2/(κ+1))^(κ/(κ-1)) (Saint-Venant and Wantzel 1839).

    Parameters
    ----------
    inner_pa, outer_pa : pressures
    inner, outer : densities there, kg/m³
    kappa : isentropic exponent
    """
    forward = inner_pa >= outer_pa
    high, low, density = (inner_pa, outer_pa, inner) if forward else (outer_pa, inner_pa, outer)
    power = (kappa - 1.0) / kappa
    if abs(kappa - 1.0) < ALMOST:
        fall = min(np.log(high / low), 0.5)
        work = fall
    else:
        critical = np.log((kappa + 1.0) / 2.0) / power
        fall = min(np.log(high / low), critical)
        work = -np.expm1(-power * fall) / power
    flow = density * np.exp(-fall / kappa) * np.sqrt(2.0 * high / density * work)
    return float(flow if forward else -flow)
