"""Gas under the top cap in a study: it adds to the gas forces' sound, may be left out, is drawn."""

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
from vibroacoustics.mechanics.loads import DISCHARGE_DOME
from vibroacoustics.radiation.pressure import pressure_per_shell_velocity
from vibroacoustics.sources.cases import loads_of
from vibroacoustics.sources.gas import gas_cycle
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.cavity.of_machine import gas_of
from vibroacoustics.transfer.frame import frame_on_shell
from vibroacoustics.transfer.shell_modes import velocity_per_force

WITHOUT = 'without = ["frame"]\n'
TEXT = SOURCES_STUDY.read_text(encoding="utf-8")
INERTIA = '[machine.override.gas]\nopening_law = "inertia"\n'
GAS_ALONE = '[sources.gas]\nkind = "scroll-gas"\n'


def text_with(tables="", without=WITHOUT, law=INERTIA):
    """The gas alone, without options and draws of the others."""
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
    text = text_with(without='without = ["frame", "discharge_dome"]\n')
    return load_text(tmp_path_factory.mktemp("bare"), text)


def test_the_port_feeds_the_dome(study):
    """Volume flow by order: its mean is that of the mass flow at the density of the discharge."""
    case = case_of(study)
    (flow,) = loads_of(study, case)["gas"].flows
    assert flow.into == DISCHARGE_DOME
    gas = study.machine.gas
    assert flow.density_kg_per_m3 == gas.discharge_density_kg_per_m3
    assert flow.sound_speed_m_per_s == gas.discharge_sound_speed_m_per_s
    mass = gas_cycle(study.machine, case.shared, case.speed_rpm).port_flow_kg_per_s
    assert flow.volume_flow[0] == pytest.approx(mass.mean() / 112.0)
    lines = all_lines(case, loads_of(study, case))
    assert lines.flows["gas"][0].volume_flow.shape == lines.frequency_hz.shape


def test_pressures_of_dome_and_forces_add_as_phasors(study, without):
    """What the dome changes at a line is flow times modal force, mobility and transfer vector."""
    gain = 0.01
    both, bare = (
        run_made_up(one, gain)["pressure_line"]
        .sel(sound_source="gas", option="none", receiver="front_1m", speed=2900.0)
        .values
        for one in (study, without)
    )
    case, path = case_of(study), path_of(without)
    lines = all_lines(case, loads_of(study, case))
    (flow,), frequency = lines.flows["gas"], lines.frequency_hz
    forces = gas_of(study.machine, path)[DISCHARGE_DOME].wall_forces(112.0, 178.0, frequency)
    moving = velocity_per_force(path.natural_hz, path.modal_mass_kg, 0.01, frequency)
    vectors = pressure_per_shell_velocity(made_up_modes(without, gain))(frequency)[0]
    expected = (vectors * moving * forces).sum(axis=0) * flow.volume_flow
    scale = np.abs(expected).max()
    assert scale > 1e-9
    np.testing.assert_allclose(both - bare, expected, atol=1e-9 * np.abs(bare).max())


def test_dome_is_drawn_and_left_out(study, without):
    names = {limits.name for limits in study.ranges}
    assert {"discharge_dome.port_offset_m", "discharge_dome.quality_ratio"} <= names
    assert "discharge_dome.depth_m" not in names
    assert {limits.name for limits in study.held_ranges} >= {"discharge_dome.depth_m"}
    assert not any("discharge_dome" in limits.name for limits in without.ranges)
    assert loads_of(without, case_of(without))["gas"].flows == ()
    by_draw = run_made_up(study, gain=0.01)["source_level_by_draw"].sel(
        sound_source="gas", option="none"
    )
    assert np.all(np.isfinite(by_draw.values))


def test_an_opening_by_an_angle_has_no_flow(tmp_path):
    angle = load_text(tmp_path, text_with(law=""))
    assert loads_of(angle, case_of(angle))["gas"].flows == ()
    assert not any("discharge_dome" in limits.name for limits in angle.ranges)


def test_parts_of_a_frame_answer_the_gas_too(tmp_path):
    """Mobility of the framed shell's modes is symmetric; parts held softly do nothing."""
    framed = load_text(tmp_path, text_with(without=""))
    path = path_of(framed)
    on_shell = frame_on_shell(framed.machine, path)
    frequency = np.array([0.0, 510.0, 1010.0, 1400.0])
    count = path.natural_hz.size
    alone = velocity_per_force(path.natural_hz, path.modal_mass_kg, 0.01, frequency)
    each = []
    for mode in range(count):
        unit = np.repeat(np.eye(count)[mode][:, None], frequency.size, axis=1) + 0j
        forces = on_shell.under_modal_forces(unit, frequency)
        each.append(alone * forces.on_modes[:, 0, 0])
        assert forces.rigid_velocity.shape == (6, 1, 1, frequency.size)
        assert not forces.rigid_velocity[..., 0].any()
    mobility = np.array(each)
    np.testing.assert_allclose(
        mobility, mobility.swapaxes(0, 1), atol=1e-9 * np.abs(mobility).max()
    )
    assert np.abs(mobility - np.eye(count)[..., None] * alone).max() > 0.01 * np.abs(alone).max()
    soft = dict.fromkeys(("weld_n_per_m", "leg_n_per_m", "land_n_per_m"), 0.001)
    contacts = framed.machine.frame.contacts.model_copy(update=soft)
    loose = with_tables(framed, frame={"contacts": contacts})
    unit = np.ones((count, frequency.size), dtype=complex)
    free = frame_on_shell(loose.machine, path).under_modal_forces(unit, frequency)
    np.testing.assert_allclose(free.on_modes[:, 0, 0], unit, atol=1e-6)


# --- bad input ---


@pytest.mark.parametrize(
    ("new", "words"),
    [
        ("depth_mm = { value = 600.0", ["discharge_dome.depth_mm = 600 mm", "between the caps"]),
        ("port_offset_mm = { value = 90.0", ["discharge_dome.port_offset_mm = 90 mm", "radius"]),
        ("tube_height_mm = { value = 20.0", ["tube_height_mm = 20 mm", "at most depth_mm = 17 mm"]),
        ("quality_ratio = { value = 0.5", ["discharge_dome.quality_ratio = 0.5", "2 to 10000"]),
    ],
)
def test_bad_domes_are_one_line(tmp_path, new, words):
    table = f'[machine.override.discharge_dome]\n{new}, source = "test" }}\n'
    with pytest.raises(ParameterError) as refusal:
        load_text(tmp_path, text_with(tables=table))
    lines = str(refusal.value).splitlines()
    assert any(all(word in line for word in words) for line in lines), lines


def test_measured_modes_and_gas_in_the_shell_are_refused(tmp_path):
    with pytest.raises(ParameterError, match=r'without = \["discharge_dome"\]'):
        load_text(tmp_path, text_with(tables='[shell_modes]\nfile = "modes.uff"\n'))
