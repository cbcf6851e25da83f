"""Units in the suffix of a key."""

import math

import pytest

from vibroacoustics.base.errors import PluginError
from vibroacoustics.base.registry import register
from vibroacoustics.base.units import (
    UNITS,
    Unit,
    shaft_frequency_hz,
    si_key,
    split_key,
)
from vibroacoustics.results import labels


@pytest.mark.parametrize(
    ("key", "name", "factor"),
    [
        ("stroke_mm", "stroke_m", 1e-3),
        ("stroke_m", "stroke_m", 1.0),
        ("clearance_um", "clearance_m", 1e-6),
        ("inertia_xx_kg_m2", "inertia_xx_kg_m2", 1.0),
        ("lateral_stiffness_n_per_mm", "lateral_stiffness_n_per_m", 1e3),
        ("damping_ns_per_m", "damping_ns_per_m", 1.0),
        ("pressure_bar", "pressure_pa", 1e5),
        ("angle_deg", "angle_rad", math.pi / 180.0),
        ("share_percent", "share_ratio", 1e-2),
        ("speed_rpm", "speed_rpm", 1.0),
        ("displacement_cm3", "displacement_m3", 1e-6),
        ("oil_g", "oil_kg", 1e-3),
        ("capacitance_uf", "capacitance_f", 1e-6),
        ("friction_torque_n_m", "friction_torque_n_m", 1.0),
        ("title", "title", 1.0),
        ("crank_angle_samples", "crank_angle_samples", 1.0),
        ("m", "m", 1.0),  # a unit alone is a name
    ],
)
def test_si_key(key, name, factor):
    assert si_key(key) == (name, pytest.approx(factor, rel=1e-15))


def test_longest_unit_wins():
    stem, unit = split_key("k_n_per_mm")
    assert stem == "k"
    assert unit is UNITS["n_per_mm"]


def test_every_unit_leads_to_an_si_unit_of_factor_one():
    for unit in UNITS.values():
        assert UNITS[unit.si_suffix].factor == 1.0


def test_a_third_partys_unit_is_shown_from_the_words_that_are_kept():
    kept = {"labels": {"heat_btu": "Heat"}, "units": {"btu": "BTU"}}
    assert labels.name("lost_heat_btu", kept) == "Lost heat"
    assert labels.unit("lost_heat_btu", kept) == "BTU"
    assert labels.name("heat_btu", kept) == "Heat"
    assert labels.unit("lost_heat_btu") == ""


def test_rpm_is_revolutions_per_minute():
    """Not the 314 Hz that a unit library makes of 3000 rpm by way of rad/s."""
    assert shaft_frequency_hz(3000.0) == 50.0


def test_a_third_partys_unit():
    register(Unit("inch", "in", "m", 0.0254))
    assert si_key("stroke_inch") == ("stroke_m", 0.0254)
    with pytest.raises(PluginError, match="unit mm: is built in"):
        register(Unit("mm", "mm", "m", 2e-3))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (("Inch", "in", "m", 0.0254), "unit 'Inch': must be small letters"),
        (("inch", "in", "m", 0.0), "unit inch: factor = 0.0: must be above zero"),
        (("k", "K", "k", 2.0), "unit k: factor = 2.0: is 1 for an SI unit"),
    ],
)
def test_malformed_unit_is_refused(values, message):
    with pytest.raises(PluginError, match=message):
        Unit(*values)
