"""k-Wave on a device: which one, its memory, and what is told where CuPy does not work.

A stand-in takes the place of CuPy and of the device.
"""

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from radiation_parts import floor
from support import cube_box

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.shell import Shell
from vibroacoustics.radiation import device, kwave, room_green, room_greens, room_grid
from vibroacoustics.radiation.scene import scene
from vibroacoustics.radiation.task import Task
from vibroacoustics.radiation.transfer_vectors import frequencies_hz
from vibroacoustics.study.radiation import RadiationSettings

FLOOR = floor(-0.1)
MICROPHONE = np.array([0.65, 0.1, 0.0])
FREQUENCY_HZ = np.arange(25.0, 501.0, 25.0)
SHELL = Shell(
    outer_diameter_m=0.165, height_m=0.417, centre_of_mass_height_m=0.2, floor_clearance_m=0.02
)


@pytest.fixture
def box():
    """A small box that ends on the floor."""
    return cube_box(0.1, 0.0125, on_floor=True)


@pytest.fixture(autouse=True)
def _forgotten():
    """What was found out about CuPy is found out again."""
    device._namespace.cache_clear()
    yield
    device._namespace.cache_clear()


def stand_in(monkeypatch, available_bytes=2**40, devices=1):
    """NumPy under the name of CuPy, with a device of some memory."""
    runtime = SimpleNamespace(
        getDeviceCount=lambda: devices,
        memGetInfo=lambda: (available_bytes, 2**40),
        getDeviceProperties=lambda _: {"name": b"made-up device"},
    )
    cupy = SimpleNamespace(**vars(np) | {"cuda": SimpleNamespace(runtime=runtime)})
    monkeypatch.setitem(sys.modules, "cupy", cupy)
    return cupy


def test_cupy_is_used_where_it_finds_a_device(monkeypatch):
    cupy = stand_in(monkeypatch)
    assert device.array_namespace() is cupy
    assert device.engine_name() == f"k-Wave's own step, CuPy {np.__version__} on made-up device"
    assert device.device_trouble() == ""


def test_without_cupy_nothing_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "cupy", None)
    device.warn_of_device()
    assert device.array_namespace() is np
    assert device.engine_name() == "compiled step on the processor"


def broken_driver():
    raise RuntimeError("cudaErrorInsufficientDriver:\nold driver" + 300 * "x")


@pytest.mark.parametrize(
    ("count", "words"),
    [(lambda: 0, "CuPy finds no device"), (broken_driver, "CuPy does not work: cudaErrorInsuff")],
)
def test_a_cupy_that_does_not_serve_is_told_in_one_line(monkeypatch, count, words):
    cupy = stand_in(monkeypatch)
    cupy.cuda.runtime.getDeviceCount = count
    with pytest.warns(UserWarning, match=f"^k-Wave runs on the processor: {words}") as told:
        device.warn_of_device()
    (one,) = told
    assert "\n" not in str(one.message)
    assert len(str(one.message)) < 200
    assert device.array_namespace() is np


def test_a_library_that_cupy_lacks_is_told(monkeypatch):
    def lacking(name):
        raise ModuleNotFoundError("No module named 'fastrlock'", name="fastrlock")

    monkeypatch.setattr("importlib.import_module", lacking)
    assert device.device_trouble() == "CuPy does not work: No module named 'fastrlock'"


def test_memory_of_the_device_is_asked_for(box, monkeypatch):
    stand_in(monkeypatch, 2**20)
    with pytest.raises(ParameterError, match=r"0\.000977 GiB are available"):
        room_green.check_receiver("far", MICROPHONE, box, 0.03, (FLOOR,), 100)


@pytest.mark.long
def test_a_run_on_a_device_is_k_wave_s_own(box, monkeypatch):
    """With thin absorbing layers, which take less time."""
    for module in (room_grid, kwave):
        monkeypatch.setattr(module, "PML_NODES", 6)
    arguments = (box, MICROPHONE, FREQUENCY_HZ, 500.0, 0.05, (FLOOR,))
    expected = room_green.kwave_green(*arguments)
    device._namespace.cache_clear()
    stand_in(monkeypatch)
    taken = []
    stock = kwave.StockEngine
    monkeypatch.setattr(kwave, "StockEngine", lambda one: taken.append(one) or stock(one))
    field = room_green.kwave_green(*arguments)
    assert len(taken) == 1
    np.testing.assert_allclose(field.outer, expected.outer, atol=1e-10 * np.abs(field.outer).max())


@pytest.mark.parametrize(("runs", "at_a_time"), [(0.5, 1), (2.9, 2), (1e3, 3)])
def test_runs_at_a_time_fit_the_device(box, monkeypatch, runs, at_a_time):
    """70 % of its memory, whatever this computer has; as many runs as microphones at most."""
    settings = RadiationSettings(room_spacing_m=0.06, maximum_frequency_hz=500.0)
    places = {name: MICROPHONE + np.array([0.0, 0.0, 0.1 * row]) for row, name in enumerate("abc")}
    table = frequencies_hz(settings)
    task = Task(scene(SHELL, settings), [], places, settings, table, table.size, tuple("abc"))
    monkeypatch.setattr(room_greens, "processors", lambda: 16)
    monkeypatch.setattr(room_greens, "memory_bytes", lambda *_: 1e9)
    stand_in(monkeypatch, int(runs * 1e9 / 0.7))
    assert room_greens._workers(box, task) == at_a_time
