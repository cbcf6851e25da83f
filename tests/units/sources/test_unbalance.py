"""Residual unbalance: m e ω² of a grade, in two planes."""

import numpy as np
import pytest
from sources_study import case_of
from support import PIPELINES

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.isolation import BalanceQuality
from vibroacoustics.sources.unbalance import WRENCH, ResidualUnbalance

ROUNDING = 3.0 * 128**2 * np.finfo(float).eps
"""Of the second derivative by a Fourier series of 256 samples."""
STUDY = PIPELINES / "mayekawa_wbhe.toml"


def quality(**values):
    given = {"grade_m_per_s": 6.3e-3, "service_speed_rpm": 3500.0, "rotor_mass_kg": 3.0,
             "lower_plane_height_m": -0.055, "upper_plane_height_m": 0.03}  # fmt: skip
    return BalanceQuality(**{**given, **values})


def wrench_of(machine, speed_rpm=2900.0, **values):
    changed = machine.model_copy(update={"balance_quality": quality(**values)})
    revolution = changed.revolution(speed_rpm, 256)
    case = va.Case(changed, va.Added(), revolution, None, 1000.0)
    return ResidualUnbalance().loads(case, {}).wrenches[WRENCH]


def test_force_is_m_e_omega_squared(thesis_study):
    """At the service speed m G ω; below it, it falls with the square of the speed."""
    machine = thesis_study.machine
    for speed in (3500.0, 2900.0):
        force = wrench_of(machine, speed)[0]
        omega = 2.0 * np.pi * speed / 60.0
        expected = 3.0 * 6.3e-3 / (2.0 * np.pi * 3500.0 / 60.0) * omega**2
        np.testing.assert_allclose(np.hypot(force[0], force[1]), expected, rtol=ROUNDING)
        assert np.abs(force[2]).max() == 0.0
        # ahead of the crank pin, in its sense
        np.testing.assert_allclose(force[0, [0, 64]], [expected, 0.0], atol=1e-9 * expected)
        np.testing.assert_allclose(force[1, [0, 64]], [0.0, expected], atol=1e-9 * expected)


def test_opposite_halves_are_a_couple(thesis_study):
    force, moment = wrench_of(thesis_study.machine, 3500.0, upper_angle_rad=np.pi)
    unit = 0.5 * 3.0 * 6.3e-3 * 2.0 * np.pi * 3500.0 / 60.0
    assert np.abs(force).max() < ROUNDING * unit
    np.testing.assert_allclose(np.hypot(moment[0], moment[1]), unit * 0.085, rtol=1e-9)


def test_share_of_planes_and_of_the_grade(thesis_study):
    machine = thesis_study.machine
    one = wrench_of(machine, upper_share_ratio=1.0)
    half = wrench_of(machine, upper_share_ratio=1.0, used_ratio=0.5)
    np.testing.assert_allclose(2.0 * half[0], one[0], rtol=ROUNDING, atol=ROUNDING)
    np.testing.assert_allclose(one[1][1], 0.03 * one[0][0], atol=1e-9)


def test_planes_stand_along_the_shaft_of_a_machine_on_its_side():
    """The shaft of a reciprocating compressor lies along y: nothing pushes along it.

    About it there is the inertia of the mass off the axis alone, as its speed varies.
    """
    machine = va.load_study(STUDY).machine
    shaft = np.array(machine.crank_frame.shaft)
    force, moment = wrench_of(machine, 1000.0)
    assert np.abs(shaft @ force).max() < ROUNDING * np.abs(force).max()
    about_shaft = moment - np.cross(machine.crank_frame.origin_m, force, axis=0)
    assert np.abs(shaft @ about_shaft).max() < quality().eccentricity_m * np.abs(force).max()


def test_a_study_names_it(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        f'extends = "{PIPELINES / "copeland_thesis.toml"}"\n'
        "[operation]\nspeed_rpm = [2900.0]\n"
        '[sources.unbalance]\nkind = "residual-unbalance"\n'
    )
    study = va.load_study(path)
    loads = study.sources["unbalance"].loads(case_of(study), {})
    expected = 3.2e3 * 6.3 / (3500.0 * np.pi / 30.0)
    assert loads.figures["residual_unbalance_g_mm"] == pytest.approx(expected)
    sampled = {item.name for item in study.ranges if item.table == "balance_quality"}
    assert "balance_quality.upper_angle_rad" in sampled
    assert len(sampled) == 5


def test_a_machine_without_the_table_is_refused(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        f'extends = "{PIPELINES / "zhao_minicrank.toml"}"\n'
        '[sources.unbalance]\nkind = "residual-unbalance"\n'
    )
    with pytest.raises(ParameterError, match="needs the machine's table balance_quality"):
        va.load_study(path)
