"""Paths from ports to observers: motions, feet, refusals."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, case_of, path_of
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import PARTS
from vibroacoustics.machine.suspension import BLOCK
from vibroacoustics.mechanics.loads import lines_of
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.sources.cases import loads_of
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.transfer.bending import bending_shell
from vibroacoustics.transfer.contributions import velocities
from vibroacoustics.transfer.load_path import LoadPath
from vibroacoustics.transfer.machine import on_mounts
from vibroacoustics.transfer.observers import Observers, feet, motions

FREQUENCY = np.array([0.0, 48.3, 517.0, 1333.0])
MACHINES = ROOT / "data" / "machines"


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY)


def random_loads(ports):
    random = np.random.default_rng(2)
    shapes = {port: (2, len(port.components), FREQUENCY.size) for port in ports}
    parts = {port: random.normal(size=shape) for port, shape in shapes.items()}
    return {port: real + 1j * imaginary for port, (real, imaginary) in parts.items()}


@pytest.mark.parametrize("frame", [True, False])
def test_motions_observed_by_port_are_those_under_all_loads_together(study, frame):
    """By reciprocity, port by port, against the loads put on directly."""
    path = path_of(study)
    machine = va.load_study(ROOT / "pipelines" / "copeland_sources.toml").machine
    machine = machine if frame else machine.model_copy(update={"frame": None})
    shell = bending_shell(machine, path)
    gas = va.GasPort("discharge_dome", density_kg_per_m3=112.0, sound_speed_m_per_s=178.0)
    loads = random_loads([*PARTS, gas])
    count = len(path.modes)
    found = LoadPath(on_mounts(machine), shell).observed(motions(count), loads, FREQUENCY)
    expected = velocities(shell, loads, FREQUENCY)
    for some in (slice(0, count), slice(count, count + 3), slice(count + 3, None)):
        allowed = 1e-9 * np.abs(expected[some]).max()
        np.testing.assert_allclose(found[some], expected[some], rtol=0.0, atol=allowed)
    assert np.abs(expected[:count]).max() > 0.0


@pytest.mark.parametrize("name", ["copeland_zp41k3e", "dagilis_slider_link"])
def test_feet_feel_what_the_bodies_on_their_mounts_do(name):
    body = on_mounts(load_machine(MACHINES / f"{name}.toml"))
    loads = random_loads({HOUSING, body.mechanism_port})
    found = LoadPath(body).observed(feet(body), loads, FREQUENCY)
    expected = sum(
        body.response(load.T, FREQUENCY, port).foot_force for port, load in loads.items()
    )
    np.testing.assert_allclose(found.T[1:].reshape(3, -1, 3), expected[1:], rtol=1e-9)
    assert not found[:, 0].any()  # a steady force is no sound


def test_ports_of_other_machines_are_refused(study):
    machine = study.machine.model_copy(update={"stator_yoke": None})
    path = LoadPath(on_mounts(machine), bending_shell(machine, path_of(study)))
    microphone = Observers(lambda at: np.ones((1, 6, at.size)), lambda at: np.ones((1, 0, at.size)))
    other = va.GasPort("suction_dome", density_kg_per_m3=1.0, sound_speed_m_per_s=1.0)
    for port in (BLOCK, other, va.STATOR_YOKE):
        with pytest.raises(ParameterError, match=f"port {port.name}: the machine has none"):
            path.response(microphone, [port], FREQUENCY)


def test_sparse_lines_are_those_of_all(study):
    case = case_of(study)
    lines = lines_of(loads_of(study, case), case.shaft_frequency_hz, 20)
    path = LoadPath(on_mounts(study.machine))
    microphone = Observers(lambda at: np.ones((2, 6, 1)) * at)
    whole = path.response(microphone, [HOUSING], lines.frequency_hz)
    some = path.response(microphone, [HOUSING, HOUSING], lines.frequency_hz, np.array([3, 7]))
    np.testing.assert_array_equal(some[:, 6:], whole[..., [3, 7]])


def test_a_source_in_the_shell_must_say_so(study):
    class Silent(va.Source):
        kind = "silent"

        def loads(self, case, before):
            return va.Loads(lines={va.STATOR: np.zeros((6, 3), complex)})

    quiet = study.model_copy(update={"sources": {"fan": Silent()}})
    with pytest.raises(ParameterError, match=r"sources\.fan: .*stator.*drives_shell = True"):
        loads_of(quiet, case_of(quiet))
