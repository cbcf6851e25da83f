"""Sound of the moving parts of a drawn machine, on its drawn mounts."""

from collections.abc import Collection, Mapping

import numpy as np

from ..base.arrays import Array, ComplexArray
from ..base.units import shaft_frequency_hz
from ..machine.source import Case
from ..mechanics.loads import Loads
from ..mechanics.moving_parts import Wrench
from ..orders.spectrum import order_spectrum_at_speed
from ..transfer import on_mounts
from ..transfer.force_sound import PressurePerVelocity, of_body
from ..transfer.received import BySource


def wrench_pressure(
    case: Case, loads: Mapping[str, Loads], highest_order: int, rigid: PressurePerVelocity
) -> BySource:
    """Pressure of the wrenches over crank angle by source, (receiver, order), Pa.

    Parameters
    ----------
    case : with its revolution
    loads : of all sources, with their wrenches
    highest_order : of the result
    rigid : pressure per velocity of the rigid motions
    """
    orders = np.arange(highest_order + 1, dtype=np.float64)
    frequency: Array = shaft_frequency_hz(case.speed_rpm) * orders
    body = on_mounts(case.machine)
    vectors = of_body(rigid, body)(frequency)
    speed = case.revolution.rotation.speed_rad_per_s
    pressure = {}
    for source, load in loads.items():
        if load.wrenches:
            spectrum = _orders(load.wrenches.values(), speed, highest_order)
            velocity = body.response(spectrum.T, frequency).velocity
            pressure[source] = np.einsum("rdf,fd->rf", vectors, velocity)
    return pressure


def _orders(
    wrenches: Collection[Wrench], speed_rad_per_s: Array, highest_order: int
) -> ComplexArray:
    """Force and moment of all wrenches together, shape (6, order)."""
    total = np.sum([np.concatenate([one.force_n, one.moment_n_m]) for one in wrenches], axis=0)
    return order_spectrum_at_speed(total, speed_rad_per_s, highest_order)
