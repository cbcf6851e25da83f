"""Gas in the shell in a study: it adds to the gas forces' sound, may be left out, is sampled."""

import numpy as np
import pytest
from sources_study import (
    SOURCES_STUDY,
    all_lines,
    case_of,
    made_up_modes,
    path_of,
    run_made_up,
    with_tables,
)
from support import ROOT

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.cavities import SPACES, GasPort
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.orders import order_spectrum
from vibroacoustics.radiation.pressure import pressure_per_shell_velocity
from vibroacoustics.sources.cases import loads_of
from vibroacoustics.sources.gas import gas_cycle
from vibroacoustics.sources.scroll_gas.cycle import scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.opening import steady_opening, steps_of_turn
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.cavity.of_machine import gas_of
from vibroacoustics.transfer.frame.of_machine import frame_on_shell
from vibroacoustics.transfer.natural_frequencies import gas_frequencies
from vibroacoustics.transfer.shell_modes.projection import velocity_per_force

DISCHARGE_DOME, SUCTION_ANNULUS = SPACES
WITHOUT = 'without = ["frame"]\n'
TEXT = SOURCES_STUDY.read_text(encoding="utf-8")
INERTIA = '[machine.override.gas]\nopening_law = "inertia"\n'
GAS_ALONE = '[sources.gas]\nkind = "scroll-gas"\n'


def text_with(tables="", without=WITHOUT, law=INERTIA):
    """The gas alone, without options and samples of the others."""
    start, stop = TEXT.index("[sources.gas]"), TEXT.index("[uncertainty]")
    options = TEXT.index("[options.counterweight-half]"), TEXT.index("[receivers.front_1m]")
    text = TEXT[: options[0]] + TEXT[options[1] : start] + GAS_ALONE + law + tables + TEXT[stop:]
    return text.replace(WITHOUT, without).replace("stopping = true", 'point = "ari"')


def load_text(folder, text):
    (folder / "study.toml").write_text(text.replace("../../data", str(ROOT / "data")))
    return load_study(folder / "study.toml")


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return load_text(tmp_path_factory.mktemp("domed"), text_with())


@pytest.fixture(scope="module")
def without(tmp_path_factory):
    text = text_with(without='without = ["frame", "discharge_dome", "suction_annulus"]\n')
    return load_text(tmp_path_factory.mktemp("bare"), text)


def flows_of(study):
    """Port and volume flow by order, by the space's name."""
    lines = loads_of(study, case_of(study))["gas"].lines
    return {port.name: (port, load[0]) for port, load in lines.items() if isinstance(port, GasPort)}


def test_the_port_feeds_the_dome(study):
    """Volume flow by order: its mean is that of the mass flow at the density of the discharge."""
    case, (port, flow) = case_of(study), flows_of(study)[DISCHARGE_DOME]
    gas = study.machine.gas
    assert port.density_kg_per_m3 == gas.discharge_density_kg_per_m3
    assert port.sound_speed_m_per_s == gas.discharge_sound_speed_m_per_s
    mass = gas_cycle(study.machine, case.shared, case.speed_rpm).port_flow_kg_per_s
    assert flow[0] == pytest.approx(mass.mean() / 112.0)
    lines = all_lines(case, loads_of(study, case))
    assert lines.loads["gas"][port].shape == (1, lines.frequency_hz.size)


def test_natural_frequencies_of_the_gas(study):
    """Of the annulus about c n/(2 pi R) with its mean radius; none of spaces that are not fed."""
    annulus, flows = study.machine.suction_annulus, flows_of(study)
    speeds = {name: port.sound_speed_m_per_s for name, (port, _) in flows.items()}
    named = gas_frequencies(study.machine, path_of(study), speeds)
    wall = study.machine.shell.cylinder.radius_m - study.machine.structure.thickness_m
    mean = 0.5 * (annulus.inner_radius_m + wall)
    once = speeds[SUCTION_ANNULUS] / (2.0 * np.pi * mean)
    assert named[f"{SUCTION_ANNULUS}_n2_1"] == pytest.approx(2.0 * once, rel=0.01)
    assert list(named.values()) == sorted(named.values())
    some = gas_frequencies(study.machine, path_of(study), {DISCHARGE_DOME: 178.0})
    assert {name.partition("_n")[0] for name in some} == {DISCHARGE_DOME}


def test_the_pockets_draw_on_the_annulus(study):
    """What they take is what they sweep, and some 3 % that closing presses in."""
    port, flow = flows_of(study)[SUCTION_ANNULUS]
    assert port.density_kg_per_m3 == pytest.approx(33.0, rel=2e-3)
    swept = 39.66e-6 * 2900.0 / 60.0
    assert -flow[0].real / swept == pytest.approx(1.03, abs=0.01)


def test_pressures_of_dome_and_forces_add_as_phasors(study, without):
    """What the dome changes at a line is flow times modal force, mobility and transfer vector."""
    gain = 0.01
    study, without = (one.model_copy(update={"ranges": ()}) for one in (study, without))
    both, bare = (
        run_made_up(one, gain)["pressure_line"]
        .sel(sound_source="gas", option="none", receiver="front_1m", speed=2900.0)
        .values
        for one in (study, without)
    )
    case, path = case_of(study), path_of(without)
    lines = all_lines(case, loads_of(study, case))
    frequency, gas = lines.frequency_hz, gas_of(study.machine, path)
    forces = 0.0
    for port, flow in lines.loads["gas"].items():
        if isinstance(port, GasPort):
            state = port.density_kg_per_m3, port.sound_speed_m_per_s
            forces = forces + gas[port.name].wall_forces(*state, frequency) * flow[0]
    moving = velocity_per_force(path.natural_hz, path.modal_mass_kg, 0.01, frequency)
    vectors = pressure_per_shell_velocity(made_up_modes(without, gain))(frequency)[0]
    expected = (vectors * moving * forces).sum(axis=0)
    scale = np.abs(expected).max()
    assert scale > 1e-9
    np.testing.assert_allclose(both - bare, expected, atol=1e-9 * np.abs(bare).max())


@pytest.mark.long
def test_gas_is_sampled_and_left_out(study, without):
    names = {limits.name for limits in study.ranges}
    assert {"discharge_dome.port_offset_m", "suction_annulus.inlets"} <= names
    shapes = {"discharge_dome.depth_m", "suction_annulus.inner_radius_m"}
    assert not shapes & names
    assert shapes <= {limits.name for limits in study.held_ranges}
    assert not any(word in limits.name for limits in without.ranges for word in ("dome", "annulus"))
    assert not flows_of(without)
    by_sample = run_made_up(study, gain=0.01)["source_level_by_sample"].sel(
        sound_source="gas", option="none"
    )
    assert np.all(np.isfinite(by_sample.values))


def test_leakage_and_filling_are_sampled_and_left_out(study, tmp_path):
    """Without both tables the torque is that of tight pockets at the suction pressure."""
    assert "leakage.tip_gap_m" in {limits.name for limits in study.ranges}
    left_out = 'without = ["frame", "leakage", "suction_pockets"]\n'
    tight = load_text(tmp_path, text_with(without=left_out))
    assert not any(limits.name.startswith("leakage") for limits in tight.ranges)
    machine, case = tight.machine, case_of(tight)
    opened = steady_opening(machine.wraps, machine.gas, machine.opening, case.speed_rpm)
    angle = uniform_crank_angle(steps_of_turn(case.speed_rpm))
    cycle = scroll_gas_cycle(machine.wraps, machine.gas, angle, opened)
    expected = order_spectrum(cycle.torque_n_m, case.maximum_order)
    obtained, leaking = (
        loads_of(one, case_of(one))["gas"].shaft_torque_n_m for one in (tight, study)
    )
    np.testing.assert_array_equal(obtained, expected)
    assert leaking[0].real / obtained[0].real == pytest.approx(1.039, abs=0.003)
    assert abs(leaking[1]) / abs(obtained[1]) == pytest.approx(0.921, abs=0.005)


def test_an_opening_by_an_angle_has_no_flow(tmp_path):
    angle = load_text(tmp_path, text_with(law=""))
    assert not flows_of(angle)
    assert not any("discharge_dome" in limits.name for limits in angle.ranges)


def test_parts_of_a_frame_answer_the_gas_too(tmp_path):
    """Mobility of the framed shell's modes is symmetric; parts held softly do nothing."""
    framed = load_text(tmp_path, text_with(without=""))
    path = path_of(framed)
    on_shell = frame_on_shell(framed.machine, path)
    frequency = np.array([0.0, 510.0, 1010.0, 1400.0])
    count = path.natural_hz.size
    alone = velocity_per_force(path.natural_hz, path.modal_mass_kg, 0.01, frequency)
    answers = answers_of_modes(on_shell, frequency)
    mobility = answers[:, :count]
    assert not answers[..., 0].any()
    np.testing.assert_allclose(
        mobility, mobility.swapaxes(0, 1), atol=1e-9 * np.abs(mobility).max()
    )
    assert np.abs(mobility - np.eye(count)[..., None] * alone).max() > 0.01 * np.abs(alone).max()
    soft = dict.fromkeys(("weld_n_per_m", "leg_n_per_m", "land_n_per_m"), 0.001)
    contacts = framed.machine.frame.contacts.model_copy(update=soft)
    loose = with_tables(framed, frame={"contacts": contacts})
    free = answers_of_modes(frame_on_shell(loose.machine, path), frequency)
    expected = np.eye(count, count + 6)[..., None] * alone[:, None]
    np.testing.assert_allclose(free, expected, atol=1e-6 * np.abs(alone).max())


def answers_of_modes(on_shell, frequency_hz):
    """Velocity of modes and rigid motions per force on each mode, (mode, motion, frequency)."""
    count = on_shell.natural_hz.size
    each = np.repeat(np.eye(count + 6)[..., None], frequency_hz.size, axis=-1)
    of_modes = on_shell.sound(each[:, :-6], each[:, -6:], frequency_hz).of_modes
    return of_modes(np.arange(frequency_hz.size)).swapaxes(0, 1)


# --- bad input ---


@pytest.mark.parametrize(
    ("table", "key", "value", "words"),
    [
        (DISCHARGE_DOME, "depth_mm", 600, ["dome.depth_mm = 600 mm", "between the caps"]),
        (DISCHARGE_DOME, "port_offset_mm", 90, ["dome.port_offset_mm = 90 mm", "radius"]),
        (DISCHARGE_DOME, "tube_height_mm", 20, ["tube_height_mm = 20 mm", "depth_mm = 17 mm"]),
        (DISCHARGE_DOME, "quality_ratio", 0.5, ["quality_ratio = 0.5", "2 to 10000"]),
        (SUCTION_ANNULUS, "inner_radius_mm", 82, ["inner_radius_mm = 82 mm", "0.98"]),
        (SUCTION_ANNULUS, "upper_height_mm", 400, ["92, 400 mm", "ends of the wall"]),
        (SUCTION_ANNULUS, "inlet_height_mm", 20, ["inlet_height_mm = 20 mm", "92 mm"]),
    ],
)
def test_bad_gas_is_one_line(tmp_path, table, key, value, words):
    number = f'{key} = {{ value = {float(value)}, source = "test" }}'
    text = f"[machine.override.{table}]\n{number}\n"
    with pytest.raises(ParameterError) as refusal:
        load_text(tmp_path, text_with(tables=text))
    lines = str(refusal.value).splitlines()
    assert any(all(word in line for word in words) for line in lines), lines


def test_measured_modes_and_gas_in_the_shell_are_refused(tmp_path):
    with pytest.raises(ParameterError, match=r"without = \['discharge_dome', 'suction_annulus'\]"):
        load_text(tmp_path, text_with(tables='[shell_modes]\nfile = "modes.uff"\n'))
