"""Curves of the gas in a scroll: pressure of a pocket, forces and their direction, torque."""

from collections.abc import Iterator
from typing import Final

import numpy as np

from ...base.arrays import Array
from ...base.curves import CRANK_ANGLES, Curve, CurveAxis, angle_axis
from ...mechanics.rotation import uniform_crank_angle
from .cycle import ScrollGasCycle, scroll_gas_cycle
from .parameters import ScrollGas, ScrollWraps
from .pockets import pocket_volume
from .pressures import pocket_pressure

AFTER_OPENING: Final = np.pi / 3.0
"""How far the pressure of a pocket is shown beyond its opening, rad."""


def scroll_gas_curves(wraps: ScrollWraps, gas: ScrollGas) -> Iterator[Curve]:
    """Pressure and volume of one pocket; forces on the fixed scroll, their direction, torques.

    Parameters
    ----------
    wraps : geometry, m and rad
    gas : pressures in Pa and polytropic index
    """
    yield from _of_a_pocket(wraps, gas)
    cycle = scroll_gas_cycle(wraps, gas, uniform_crank_angle(CRANK_ANGLES))
    angle = angle_axis(cycle.crank_angle)
    yield from _forces(cycle, angle)
    yield Curve(
        "gas_moment", "Gas torque on the shaft, gas moment on the Oldham ring",
        np.array([cycle.torque_n_m, cycle.self_rotation_moment_n_m]),
        (CurveAxis("moment_on", ["shaft, F_t r", "ring, F_t r/2"]), angle), "n_m",
        "thesis, section 6.1 corrected",
    )  # fmt: skip


def _of_a_pocket(wraps: ScrollWraps, gas: ScrollGas) -> Iterator[Curve]:
    """Figure 18."""
    end = wraps.opening_angle_rad + max(AFTER_OPENING, 1.5 * gas.equalisation_angle_rad)
    since = np.linspace(0.0, end, CRANK_ANGLES + 1, dtype=np.float64)
    yield Curve(
        "pocket_pressure", "Pressure of one pocket from its closing to its discharge",
        pocket_pressure(wraps, gas, since), (_since_closing(since),), "bar",
        "thesis, section 6.1 and figure 18",
    )  # fmt: skip
    trapped = np.linspace(0.0, wraps.opening_angle_rad, CRANK_ANGLES + 1, dtype=np.float64)
    axis = _since_closing(trapped)._replace(name="trapped_angle")
    yield Curve(
        "pocket_volume", "Volume of one pocket from its closing to its opening",
        pocket_volume(wraps, trapped), (axis,), "cm3", "thesis, (4.1), (4.2) and figure 7",
    )  # fmt: skip


def _since_closing(angle: Array) -> CurveAxis:
    return angle_axis(angle, "pocket_angle", "Crank angle since the pocket has closed")


def _forces(cycle: ScrollGasCycle, angle: CurveAxis) -> Iterator[Curve]:
    """Figures 19 and 20."""
    tangential, radial = cycle.tangential_force_n, cycle.radial_force_n
    parts = {
        "resultant in the plane": np.hypot(tangential, radial),
        "tangential F_t": tangential,
        "radial F_r": radial,
        "axial F_z": cycle.axial_force_n,
    }
    yield Curve(
        "gas_force", "Gas force on one scroll", np.array(list(parts.values())),
        (CurveAxis("part", list(parts)), angle), "n",
        "thesis, figure 19, appendix A corrected",
    )  # fmt: skip
    x, y, _ = cycle.on_orbiting_scroll_n
    directions = {
        "continuous": np.unwrap(np.arctan2(y, x)),
        "within ±90°, as drawn there": np.arctan(y / x),
    }
    yield Curve(
        "gas_force_angle", "Direction of the gas force on the orbiting scroll from x",
        np.array(list(directions.values())), (CurveAxis("reading", list(directions)), angle), "deg",
        "thesis, figure 20",
    )  # fmt: skip
