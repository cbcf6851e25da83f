"""Answers on gas forces of a scroll."""

import numpy as np

from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.orders import order_spectrum
from vibroacoustics.sources.scroll_gas.cycle import scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.parameters import ScrollGas, ScrollWraps

from .case import Answer, Answers, Case

_SAMPLES = 7200


def scroll_gas(case: Case) -> Answers:
    """Answer with the forces, torque and work of both operating points."""
    values = case.values
    wraps = ScrollWraps(
        base_radius_m=values["base_radius"] / 1e3,
        height_m=values["height"] / 1e3,
        thickness_m=values["thickness"] / 1e3,
        start_angle_rad=float(np.radians(values["start_angle"])),
        turns=values["turns"],
        closing_crank_angle_rad=0.0,
    )
    for name in ("appendix", "heating"):
        suction_bar, discharge_bar = values[f"{name}_suction"], values[f"{name}_discharge"]
        gas = ScrollGas(
            suction_pressure_pa=1e5 * suction_bar,
            discharge_pressure_pa=1e5 * discharge_bar,
            polytropic_index=values[f"{name}_index"],
        )
        cycle = scroll_gas_cycle(wraps, gas, uniform_crank_angle(_SAMPLES))
        mean_torque = float(cycle.torque_n_m.mean())
        label = f"{suction_bar:g} to {discharge_bar:g} bar"
        yield Answer(f"{label}: work per revolution", "J", 2.0 * np.pi * mean_torque)
        yield Answer(f"{label}: mean torque", "N m", mean_torque)
        mean_force = float(cycle.tangential_force_n.mean())
        yield Answer(f"{label}: mean tangential force", "N", mean_force)
        yield Answer(f"{label}: radial force", "N", float(cycle.radial_force_n.mean()))
        orders = np.abs(order_spectrum(cycle.torque_n_m, 4))
        for order in range(1, 5):
            yield Answer(f"{label}: torque order {order}", "N m", float(orders[order]))
