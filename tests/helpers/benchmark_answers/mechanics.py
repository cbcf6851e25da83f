"""Answers on forces of mechanisms."""

from typing import Any

import numpy as np

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.decibel import level_of_amplitude
from vibroacoustics.base.units import shaft_frequency_hz
from vibroacoustics.mechanics.moving_parts import circling, wrench
from vibroacoustics.mechanics.rotation import constant_rotation, uniform_crank_angle
from vibroacoustics.mechanisms.minicrank.cycle import four_bar_motion
from vibroacoustics.mechanisms.minicrank.links import Links
from vibroacoustics.mechanisms.oldham_scroll.parameters import Kinematics, OldhamScrollTables, Ring
from vibroacoustics.mechanisms.oldham_scroll.revolution import oldham_ring
from vibroacoustics.mechanisms.slider_link.parameters import (
    Heights,
    MovingMasses,
    SliderLink,
    SliderLinkTables,
)
from vibroacoustics.mechanisms.slider_link.piston import CrankState, piston_contacts
from vibroacoustics.mechanisms.slider_link.revolution import unbalance
from vibroacoustics.orders import order_spectrum, semi_major_axis

from .case import Answer, Answers, Case

_SAMPLES = 64
_SAME_SIDE = -1
"""Branch of the four-bar whose mini-crank runs along from 0 to 180°."""
_WEIGHT_RADIUS_M = 0.02


def oldham_force(case: Case) -> Answers:
    """Answer with the orders of the force of the moving ring."""
    values = case.values
    for name in ("printed", "derived"):
        ring = _scroll(values["ring_mass"] / 1e3, values[f"{name}_orbit_radius"])
        for speed_rpm in (values["slow_speed"], values["fast_speed"]):
            rotation = constant_rotation(speed_rpm, _SAMPLES)
            force = wrench(oldham_ring(ring, rotation.crank_angle), rotation).force_n
            orders = order_spectrum(force[0], 2)
            label = f"{name} radius, {speed_rpm:g} rpm"
            yield Answer(f"{label}: order 1 cosine", "N", orders[1].real)
            yield Answer(f"{label}: order 1 sine", "N", -orders[1].imag)
            yield Answer(f"{label}: order 2 amplitude", "N", abs(orders[2]))


def counterweight_optimum(case: Case) -> Answers:
    """Answer with the weight that a search finds for the least peak force."""
    from scipy.optimize import minimize

    values = case.values
    machine = _scroll(values["ring_mass"], values["orbit_radius"] / 1e3)
    largest = values["ring_mass"] * values["orbit_radius"] / 1e3

    def peak_n(parts: Array, speed_rpm: float) -> float:
        rotation = constant_rotation(speed_rpm, _SAMPLES)
        mass_kg = float(np.hypot(*parts)) / _WEIGHT_RADIUS_M
        turned = rotation.crank_angle + float(np.arctan2(parts[1], parts[0]))
        weight = circling("balancer", mass_kg, _WEIGHT_RADIUS_M, 0.0, turned)
        force = wrench((*oldham_ring(machine, rotation.crank_angle), weight), rotation).force_n
        return float(semi_major_axis(order_spectrum(force, 1), axis=0)[1])

    start = np.array([0.1, 0.2]) * largest
    speeds = (values["slow_speed"], values["fast_speed"])
    tight = {"xatol": 1e-5 * largest, "fatol": 1e-6}
    best = minimize(peak_n, start, (speeds[0],), "Nelder-Mead", options=tight).x
    angle_deg = float(np.degrees(np.arctan2(best[1], best[0])) % 360.0)
    yield Answer("mass moment", "kg m", float(np.hypot(*best)))
    yield Answer("angle ahead of the crank pin", "deg", angle_deg)
    for speed_rpm in speeds:
        yield Answer(f"least peak force, {speed_rpm:g} rpm", "N", peak_n(best, speed_rpm))
    ratio = peak_n(best, speeds[0]) / peak_n(0.0 * best, speeds[0])
    yield Answer("change of the peak", "dB", float(level_of_amplitude(ratio)))


def _scroll(ring_mass_kg: float, orbit_radius_m: float) -> OldhamScrollTables:
    """Return a machine of which only the ring is read."""
    tables: Any = {
        "kinematics": Kinematics(orbit_radius_m=orbit_radius_m),
        "oldham": Ring(mass_kg=ring_mass_kg, height_m=0.0),
    }
    return OldhamScrollTables.model_construct(**tables)


def minicrank_torque(case: Case) -> Answers:
    """Answer with the torque that turns the scroll of a four-bar with errors."""
    settings = ((-10, 0, 1500.0), (-100, 0, 1500.0), (-100, 0, 3000.0), (-50, 20, 1500.0))
    near_dead_centre = np.radians(np.linspace(-9.0, 9.0, 1801))
    degrees = np.array([-3.0, 1.0, 2.0, 45.0, 200.0])
    for crank_um, scroll_um, speed_rpm in settings:
        links = _links(case, crank_um, scroll_um)
        label = f"crank {crank_um} um, scroll {scroll_um} um, {speed_rpm:g} rpm"
        omega = 2.0 * np.pi * shaft_frequency_hz(speed_rpm)
        scale = case.values["scroll_inertia"] * omega**2

        def torque(angle: Array, links: Links = links, scale: float = scale) -> Array:
            scroll = four_bar_motion(links, angle, _SAME_SIDE).scroll_angle
            return np.asarray(scale * scroll[2] * scroll[1])

        largest = float(np.abs(torque(near_dead_centre)).max())
        yield Answer(f"{label}: largest torque", "N m", largest)
        for degree, value in zip(degrees, torque(np.radians(degrees)), strict=True):
            yield Answer(f"{label}: torque at {degree:g} deg", "N m", float(value))
        motion = four_bar_motion(links, np.radians([45.0]), _SAME_SIDE)
        for name, angle in (
            ("scroll", motion.scroll_angle),
            ("mini-crank", motion.minicrank_angle),
        ):
            yield Answer(f"{label}: {name} angle at 45 deg", "rad", float(angle[0, 0]))


def _links(case: Case, crank_um: float, scroll_um: float) -> Links:
    crank, scroll, minicrank, bracket = (
        case.values[name] / 1e3 for name in ("crank", "scroll", "minicrank", "bracket")
    )
    return Links(crank + 1e-6 * crank_um, scroll + 1e-6 * scroll_um, minicrank, bracket)


def slider_link_invariants(case: Case) -> Answers:
    """Answer with the contact forces on the piston and the force of the moving parts."""
    machine = _slider_link(case)
    mechanism, values = machine.mechanism, case.values
    degrees = np.array([40.0, 160.0, 250.0])
    state = _state(values["speed"], np.radians(degrees))
    inertia = -values["piston_mass"] * mechanism.crank_radius_m * state.along
    contacts = piston_contacts(
        mechanism, state, values["gas_force"] + inertia, inertia * mechanism.piston_mass_offset_m
    )
    for row, degree in enumerate(degrees):
        for name in ("front", "rear", "link"):
            force = float(getattr(contacts, name)[row])
            yield Answer(f"contact force {name} at {degree:g} deg", "N", force)
    turn = _state(values["speed"], uniform_crank_angle(_SAMPLES))
    parts = unbalance(machine, turn).values()
    force = np.sum([part.force_n for part in parts], axis=0)
    moment = np.sum([part.moment_n_m for part in parts], axis=0)
    for name, history, unit in (
        ("force x", force[0], "N"), ("force y", force[1], "N"), ("moment z", moment[2], "N m"),
    ):  # fmt: skip
        orders = order_spectrum(history, 2)
        yield Answer(f"{name}: order 1 cosine", unit, orders[1].real)
        yield Answer(f"{name}: order 1 sine", unit, -orders[1].imag)
        yield Answer(f"{name}: order 2 amplitude", unit, abs(orders[2]))


def _state(speed_rpm: float, angle: Array) -> CrankState:
    velocity = np.full_like(angle, 2.0 * np.pi * shaft_frequency_hz(speed_rpm))
    return CrankState(angle, velocity, np.zeros_like(angle))


def _slider_link(case: Case) -> SliderLinkTables:
    """Return a machine of which mechanism and masses alone are read."""
    lengths = (
        "crank_radius", "bore", "piston_length", "cylinder_length", "link_offset",
        "piston_mass_offset",
    )  # fmt: skip
    values = case.values
    mechanism = SliderLink(
        **{f"{name}_m": values[name] / 1e3 for name in lengths},
        slider_diameter_m=values["crank_radius"] / 1e3,
        cylinder_friction_ratio=values["cylinder_friction"],
        link_friction_ratio=values["link_friction"],
        piston_clearance_m=1e-5,  # no oil film in this case
    )
    masses = MovingMasses(
        piston_mass_kg=values["piston_mass"],
        slider_mass_kg=values["slider_mass"],
        crankshaft_mass_kg=values["crankshaft_mass"],
        crankshaft_mass_offset_m=values["crankshaft_mass_offset"] / 1e3,
        crankshaft_inertia_kg_m2=1e-3,  # at constant speed without effect
        crankshaft_product_kg_m2=0.0,
    )
    heights = Heights(piston_axis_m=0.0, upper_bearing_m=0.02, bearing_distance_m=0.05)
    tables: Any = {"mechanism": mechanism, "masses": masses, "heights": heights}
    return SliderLinkTables.model_construct(**tables)
