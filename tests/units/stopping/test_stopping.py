"""Stopping in the chain: transient response, steady running, momentum, energy, report."""

from dataclasses import replace
from functools import cached_property

import numpy as np
import pytest
import xarray as xr
from scipy.integrate import solve_ivp
from support import ROOT, TINY, made_up_transfer_vectors

from vibroacoustics import levels, pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import check, stamp
from vibroacoustics.machine.feet import Mounts
from vibroacoustics.machine.housing import Housing
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.mechanisms.oldham_scroll.revolution import scroll_parts
from vibroacoustics.report import render
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.stopping import forces_table, sentences
from vibroacoustics.stopping.equation import inertia_over_angle
from vibroacoustics.stopping.labelled import MAP_REVOLUTIONS, stopping_variables
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study
from vibroacoustics.transfer import MachineOnMounts
from vibroacoustics.transfer.isolation import Isolation
from vibroacoustics.transfer.transient import LOAD_SAMPLES, RESULT_SAMPLES, transient

SPEED = 2900.0 * np.pi / 30.0
ORBIT = """
[machine.override.kinematics]
orbit_radius_mm = { value = 3.461, source = "derived: as copeland_sources" }
"""


@pytest.fixture(scope="module")
def study(tmp_path_factory) -> Study:
    """The tiny study with a stop."""
    file = tmp_path_factory.mktemp("stopping") / "tiny_stopping.toml"
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file.write_text(text.replace("[operation]", f"{ORBIT}\n[operation]\nstopping = true", 1))
    return load_study(file)


def made_up(study: Study, motions=()) -> xr.Dataset:
    """Transfer vectors of the rigid motions, silent about the axis, and of the shell's modes."""
    vectors = made_up_transfer_vectors(study)
    for name in ("transfer_vector", "transfer_vector_closed_form"):
        vectors[name].loc[{"dof": "rz"}] = 0.0
    coords = {name: vectors[name] for name in ("receiver", "frequency")}
    coords["pattern"] = [motion.name for motion in motions]
    shape = (len(study.receivers), len(motions), vectors.sizes["frequency"])
    vectors["pattern_transfer_vector"] = stamp(
        "pattern_transfer_vector", np.full(shape, 1e-3 + 0j), coords
    )
    vectors["transfer_vector_error"] = stamp(
        "transfer_vector_error",
        0.01 * np.abs(vectors["transfer_vector"].values),
        {name: vectors[name] for name in ("receiver", "dof", "frequency")},
    )
    return vectors


def stopped(study: Study, **values: float) -> xr.Dataset:
    """The stage alone, with other values of stopping."""
    stopping = study.machine.stopping.model_copy(update=values)
    machine = study.machine.model_copy(update={"stopping": stopping})
    return stopping_variables(study, machine, body(study), made_up(study))


def body(study: Study) -> MachineOnMounts:
    machine = study.machine
    height = -machine.shell.centre_of_mass_height_m
    return MachineOnMounts(machine.housing, machine.mounts, height)


GENTLE = {
    "gas_share_ratio": 0.0,
    "shift_rad": 0.0,
    "viscous_torque_n_m_s": 0.0,
    "friction_torque_n_m": 0.12,
    "shaft_inertia_kg_m2": 5e-4,
}
"""Little drag, no gas, no shift: the shaft coasts for 2 s."""


@pytest.fixture(scope="module")
def gentle(study) -> xr.Dataset:
    return stopped(study, **GENTLE)


@pytest.fixture(scope="module")
def loaded(study) -> xr.Dataset:
    return stopped(study, shift_rad=0.0)


@pytest.fixture(scope="module")
def results(study) -> xr.Dataset:
    """The whole chain."""
    return pipeline.run(study, radiation=lambda study, _, motions: (made_up(study, motions), False))


# --- second method -------------------------------------------------------------------------------


class ViscousMounts(MachineOnMounts):
    """Damping proportional to the velocity, which an equation in time can have."""

    DAMPING_S = 2e-3

    @cached_property
    def isolation(self):
        elastic = super().isolation
        viscous = [replace(b, damping=self.DAMPING_S * b.stiffness) for b in elastic.bushings]
        return Isolation(elastic.bodies, tuple(viscous))


HOUSING = Housing(mass_kg=35.0, inertia_xx_kg_m2=0.57, inertia_yy_kg_m2=0.6, inertia_zz_kg_m2=0.12)
GROMMETS = Mounts(
    pitch_m=0.19, lateral_stiffness_n_per_m=2e4, vertical_stiffness_n_per_m=5e4,
    loss_factor_ratio=0.0,
)  # fmt: skip
BURST_S, BURST_HZ, HIGHEST_HZ = 0.01, 60.0, 500.0
DELAY_S = 3e-3


def burst(time):
    """Force and moment of different courses; at 500 Hz below exp(-(2π 440 x 0.01)²/2), nothing."""
    after = np.asarray(time)[..., None] - 0.2 - 0.01 * np.arange(6)
    size = np.array([30.0, -20.0, 5.0, 2.0, 3.0, -8.0])
    wave = np.cos(2.0 * np.pi * BURST_HZ * after + np.arange(6))
    return size * wave * np.exp(-0.5 * (after / BURST_S) ** 2)


def test_transient_is_that_of_the_equations_of_motion():
    """Six degrees of freedom integrated in time; sound of a delayed acceleration; its Fast level.

    Bursts, mounts and delay are made up.
    """
    on_mounts = ViscousMounts(HOUSING, GROMMETS, -0.19)
    rate = RESULT_SAMPLES * HIGHEST_HZ
    # The slowest mode, at 4.1 Hz, falls as exp(-½ ω² 2e-3 t) = exp(-0.66 t) ... after 30 s 2e-9.
    count = LOAD_SAMPLES * int(30.0 * rate)
    load = burst(np.arange(count) / (LOAD_SAMPLES * rate)).T
    gain = np.array([1.0, -0.4, 0.7, 0.05, 0.1, -0.2])

    def vectors(hertz):
        omega = 2.0 * np.pi * hertz
        return (gain[:, None] * 1j * omega * np.exp(-1j * omega * DELAY_S))[None]

    found = transient(on_mounts, load, LOAD_SAMPLES * rate, vectors)
    isolation = on_mounts.isolation
    mass, stiff = np.diag(isolation.mass_matrix), isolation.stiffness_matrix

    def acceleration(time, state):
        moved, speed = np.split(state, 2)
        return (burst(time) - stiff @ (moved + on_mounts.DAMPING_S * speed)) / mass

    end = 1.0
    solution = solve_ivp(
        lambda t, y: np.concatenate([y[6:], acceleration(t, y)]), (0.0, end), np.zeros(12),
        method="DOP853", rtol=1e-10, atol=1e-14, max_step=5e-3, dense_output=True,
    )  # fmt: skip
    time = np.arange(int(end * rate)) / rate
    moved, speed = np.split(solution.sol(time), 2)
    feet = np.einsum(
        "fai,it->fat", isolation.bushing_motion[:, :3], moved + on_mounts.DAMPING_S * speed
    )
    feet *= np.array([2e4, 2e4, 5e4])[:, None]  # of GROMMETS
    # The dense output of a method of order 8 with steps of 5 ms is good to about 1e-7.
    scale = np.abs(feet).max()
    assert np.abs(found.foot_force_n[..., : time.size] - feet).max() < 1e-6 * scale
    earlier = np.maximum(time - DELAY_S, 0.0)
    state = solution.sol(earlier)
    heard = gain @ np.stack([acceleration(*pair) for pair in zip(earlier, state.T, strict=True)], 1)
    pressure = found.pressure_pa[0, : time.size]
    assert np.abs(pressure - heard).max() < 1e-6 * np.abs(heard).max()
    first, second = (
        levels.recorded_levels(each, rate, 2e-5, "A").fast_maximum_db for each in (pressure, heard)
    )
    assert first == pytest.approx(float(second), abs=1e-4)  # 20 lg(1 + 1e-6) and A's slope


# --- steady running ------------------------------------------------------------------------------


@pytest.mark.slow
def test_steady_running_is_that_of_the_orders(gentle, results):
    """Feet and 1x line before switch-off are the chain's."""
    steady = gentle.sel(stopping_phase="steady")
    foot = results["foot_force_amplitude"].sel(option="none", order=1).max("foot")
    # The load is faded in by half a cosine over 1 s: at the rocking's 44 Hz distance it leaves
    # (π/1 s)²/(2 (2π 44/s)²) 1/(2π 44 x 1 s) = 2e-7 of the resonance. The roll kick's forerunner,
    # η/(π ω² t²) of 0.12 N m/(4 x 0.135 m) at t = 52 ms and 17.5 Hz, is 1e-3 x 0.22 N.
    assert steady["stopping_foot_force"].values == pytest.approx(foot.values, abs=3e-4)
    line = results["order_level"].sel(option="none", order=1, receiver="front_1m")
    # A Fast mean square of a tone at ω swings by 1/√(1 + (2ωτ)²) about its mean.
    swing = 10.0 * np.log10(1.0 + 1.0 / np.hypot(1.0, 2.0 * SPEED * 0.125))
    # Settling over twelve time constants, 3e-5 dB; samples beside the swing's top, (ω/rate)²/2 of
    # its 0.06 dB, 2e-4 dB; roll is silent, and the ring's own kick is 1e-3 of its force.
    assert steady["stopping_fast_maximum_level"].sel(receiver="front_1m").values == pytest.approx(
        line.sel(weighting="A").values + swing, abs=1e-3
    )
    # The peak of a tone lies 3 dB over its level; beside it, 20 lg(1 - (ω/rate)²/8) = -6e-3.
    assert steady["stopping_peak_level"].sel(receiver="front_1m").values == pytest.approx(
        line.sel(weighting="Z").values + 10.0 * np.log10(2.0), abs=1e-2
    )


def test_little_drag_changes_little(gentle):
    """In the first 0.04 s the speed falls by α t/Ω, the forces by at most twice that."""
    inertia = GENTLE["shaft_inertia_kg_m2"]
    slowed = GENTLE["friction_torque_n_m"] / inertia * 0.04 / SPEED  # more: inertia of the parts
    time = gentle["stopping_time"]
    soon = (time >= 0.0) & (time < 0.04)
    for name in ("stopping_force", "stopping_shaft_speed"):
        history = np.abs(gentle[name].isel(speed=0))
        before, after = (history.where(each).max().item() for each in (time < 0.0, soon))
        assert after == pytest.approx(before, rel=2.0 * slowed), name
    # Over the speed A-weighting rises by 24 dB an octave here, the velocity and the vectors by 6
    # each; a Fast level follows 27 % of it in 0.04 s.
    level = gentle["stopping_fast_level"].isel(speed=0)
    before, after = (level.where(each).min().item() for each in (time < 0.0, soon))
    assert after == pytest.approx(before, abs=0.27 * 36.0 * np.log2(1.0 + slowed))


# --- momentum and energy -------------------------------------------------------------------------


def inertia_about_shaft(study: Study) -> float:
    """Rotor and what circles with it; the ring only slides."""
    crank_angle = uniform_crank_angle(256)
    parts = [p for p in scroll_parts(study.machine, crank_angle) if p.source != "oldham"]
    own = study.machine.stopping.shaft_inertia_kg_m2
    return own + float(inertia_over_angle(parts, np.zeros(1))[0])


def after_switch_off(results: xr.Dataset) -> tuple[xr.Dataset, float]:
    time = results["stopping_time"].values
    stopping = results.isel(speed=0, stopping_time=time >= 0.0)
    return stopping, time[1] - time[0]


def test_housing_gets_the_momentum_of_the_shaft(study, loaded):
    """∫ roll moment dt = J Ω, ∫ force dt = 0: the ring stands at its end when switched off."""
    stopping, step = after_switch_off(loaded)
    roll = stopping["stopping_moment"].sel(axis="z").values
    # Rectangles: half a sample of the jumps at switch-off and at rest, of a duration of 0.1 s.
    allowed = roll.max() * step
    assert roll.sum() * step == pytest.approx(inertia_about_shaft(study) * SPEED, abs=allowed)
    force = stopping["stopping_force"].values
    pushed = np.abs(force.sum(axis=-1) * step)
    assert np.all(pushed <= np.abs(force).max() * step)


def test_roll_moment_takes_the_energy_of_the_shaft(study, loaded):
    """∫ moment x speed dt = ½ J Ω²."""
    stopping, step = after_switch_off(loaded)
    power = stopping["stopping_moment"].sel(axis="z") * stopping["stopping_shaft_speed"]
    kinetic = 0.5 * inertia_about_shaft(study) * SPEED**2
    assert power.sum().item() * step == pytest.approx(kinetic, abs=power.max().item() * step)


def test_feet_bear_the_roll_moment(study, loaded):
    """A moment M that comes at once and stays: M/(4 r) at rest, at most twice that by overshoot."""
    moment = np.abs(loaded["stopping_moment"].sel(axis="z")).max().item()
    rest = moment / (4.0 * study.machine.mounts.pitch_m / np.sqrt(2.0))
    foot = loaded["stopping_foot_force"].sel(stopping_phase="stopping").item()
    assert rest < foot < 2.0 * rest + loaded["stopping_foot_force"].sel(stopping_phase="steady")


# --- order map -----------------------------------------------------------------------------------


def test_order_map_follows_the_square_of_the_speed(study, loaded):
    """First order along x is the ring's, m r Ω², without a shift."""
    spectra = loaded["stopping_order_map"].sel(axis="x", map_order=1.0)
    speed = spectra["stopping_block_speed"].values * np.pi / 30.0
    machine = study.machine
    exact = machine.oldham.mass_kg * machine.kinematics.orbit_radius_m * speed**2
    # Over a block the speed falls by s = ΔΩ/Ω; its mean square is that of its mean but for s²/4.
    torque = study.machine.stopping
    drag = torque.friction_torque_n_m + torque.viscous_torque_n_m_s * speed
    fall = drag / inertia_about_shaft(study) * 2.0 * np.pi * MAP_REVOLUTIONS / speed**2
    assert np.all(np.abs(spectra.values / exact - 1.0) < 0.3 * fall**2 + 1e-3)
    assert loaded["stopping_revolutions"].item() < MAP_REVOLUTIONS
    assert spectra.size > 10


def test_no_order_map_without_revolutions(study):
    """Friction alone stops the shaft within a few."""
    for torque in (10.0, 300.0):
        assert "stopping_order_map" not in stopped(study, friction_torque_n_m=torque)
    assert "stopping_order_map" not in stopped(study, friction_torque_n_m=0.0)


# --- the whole chain -----------------------------------------------------------------------------


@pytest.mark.slow
def test_stopping_comes_out_of_the_chain(results):
    names = [name for name in results.data_vars if str(name).startswith("stopping_")]
    assert len(names) == 11
    check(results)
    for name in names:
        assert np.all(np.isfinite(results[name])), name
    assert results["stopping_shaft_speed"].values[..., -1].item() == 0.0


@pytest.mark.slow
def test_report_has_a_section(results):
    files = render(results)
    page = files["report.html"].decode()
    assert '<div id="stopping">' in page
    assert "figures/stopping.svg" in files
    assert "figures/stopping_order_map.svg" in files
    foot = results["stopping_foot_force"].sel(stopping_phase="stopping").item()
    assert forces_table(results).rows[0][-1] == f"{foot:.1f}"
    assert "stop from the highest speed without gas load" in sentences(results)[1]
    without = sentences(results.drop_vars("stopping_order_map"))
    assert "too few for an order map" in without[1]


def test_no_section_without_a_stop():
    assert not SECTIONS["stopping"].applies(xr.Dataset())


# --- bad input -----------------------------------------------------------------------------------


def test_mounts_without_loss_ring_too_long(study):
    mounts = study.machine.mounts.model_copy(update={"loss_factor_ratio": 0.0})
    machine = study.machine.model_copy(update={"mounts": mounts})
    changed = study.model_copy(update={"machine": machine})
    with pytest.raises(ParameterError, match=r"mounts\.loss_factor_ratio: too small"):
        stopped(changed)
