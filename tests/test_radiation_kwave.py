"""The room side: k-Wave against closed forms, and what keeps it safe."""

import subprocess
import sys
import textwrap

import numpy as np
import pytest

from vibroacoustics.errors import ParameterError
from vibroacoustics.radiation import kwave, room_grid
from vibroacoustics.radiation.band_limited import STENCIL_NODES, interpolation_weights
from vibroacoustics.radiation.box import closed_box
from vibroacoustics.radiation.exact import box_green
from vibroacoustics.radiation.fft import NumpyWith, ScipyFft, fft_namespace

FLOOR_Z_M = -0.1
FREQUENCY_HZ = np.arange(25.0, 2501.0, 25.0)


@pytest.fixture(scope="module")
def box():
    """A small box that ends on the floor."""
    return closed_box(np.array([-0.1, -0.1, FLOOR_Z_M]), np.array([0.1, 0.1, 0.1]), 0.0125, True)


def simulated(box, microphone, floor_z_m=FLOOR_Z_M, spacing_m=0.03, maximum_hz=2500.0):
    frequency = FREQUENCY_HZ[maximum_hz >= FREQUENCY_HZ]
    field = kwave.kwave_green(
        box, np.array(microphone), frequency, maximum_hz, spacing_m, floor_z_m
    )
    return field, box_green(box, np.array(microphone), frequency, floor_z_m)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("microphone", "floor"),
    [((0.2, -0.6, 0.2), FLOOR_Z_M), ((0.05, -0.05, 0.6), FLOOR_Z_M), ((0.5, 0.1, 0.0), None)],
    ids=["floor", "floor-above-the-box", "free-field"],
)
def test_green_function_is_that_of_the_image_source(box, microphone, floor):
    """Level within 0.1 dB at every point of the box and every frequency to 2.5 kHz."""
    field, expected = simulated(box, microphone, floor)
    assert np.abs(kwave.green_difference_db(field, expected)).max() < 0.1
    largest = np.abs(expected.outer).max(axis=1, keepdims=True)
    assert (np.abs(field.outer - expected.outer) / largest).max() < 2e-3
    # The normal difference between the layers, against its largest value on the box.
    difference, exact = field.outer - field.inner, expected.outer - expected.inner
    assert (np.abs(difference - exact) / np.abs(exact).max(axis=1, keepdims=True)).max() < 0.03


@pytest.mark.slow
def test_microphone_on_the_floor_is_one_source_of_double_strength(box):
    field, expected = simulated(box, (0.5, 0.1, FLOOR_Z_M), maximum_hz=1000.0)
    assert np.abs(kwave.green_difference_db(field, expected)).max() < 0.1


@pytest.mark.slow
def test_time_step_does_not_matter(box, monkeypatch):
    """In a uniform medium k-Wave's scheme is exact in time: half the step changes nothing."""
    fields = []
    for courant in (0.3, 0.6):
        monkeypatch.setattr(room_grid, "COURANT_NUMBER", courant)
        fields.append(simulated(box, (1.0, 0.1, 0.1), None, 0.08, 1000.0)[0].outer)
    np.testing.assert_allclose(*fields, atol=2e-3 * np.abs(fields[0]).max())


@pytest.mark.parametrize("microphone", [(0.4, 0.1, 0.1), (0.5, 0.1, 0.3)])
def test_step_with_half_spectra_equals_the_stock_step(box, microphone):
    """FFTW's and SciPy's real transforms against untouched k-Wave on NumPy: rounding alone."""
    grid = room_grid.room_grid(np.array(microphone), box, 0.1, FLOOR_Z_M)
    pressures = []
    for namespace in (fft_namespace(grid.shape), NumpyWith(ScipyFft(grid.shape)), np):
        simulation = kwave.build_simulation(grid, np.array([0.0, 1.0, -2.0, 1.0]), 20)
        simulation.xp = namespace
        if namespace is np:
            simulation.setup()  # whole spectra again: the stock solver
        for _ in range(10):
            simulation.step()
        pressures.append(simulation.p.copy())
    scale = np.abs(pressures[2]).max()
    assert scale > 0
    for pressure in pressures[:2]:
        np.testing.assert_allclose(pressure, pressures[2], atol=1e-12 * scale, rtol=0)


def test_floor_plane_carries_no_vertical_flow(box):
    """The discrete symmetry: pressures at mirror nodes agree."""
    grid = room_grid.room_grid(np.array([0.4, 0.1, 0.1]), box, 0.1, FLOOR_Z_M)
    simulation = kwave.build_simulation(grid, np.array([0.0, 1.0, -2.0, 1.0]), 20)
    for _ in range(8):
        simulation.step()
    floor = (grid.source_nodes[0][2] + grid.source_nodes[1][2]) // 2
    above = simulation.p[:, :, floor + 1 : floor + 4]
    below = simulation.p[:, :, floor - 1 : floor - 4 : -1]
    np.testing.assert_allclose(above, below, atol=1e-4 * np.abs(simulation.p).max())


def test_interpolation_passes_waves_and_stops_ringing():
    nodes = np.arange(STENCIL_NODES) - (STENCIL_NODES // 2 - 1)
    offset = np.linspace(0.0, 1.0, 21)
    weights = interpolation_weights(offset)
    for k, error in ((0.01, 3e-5), (0.7, 3e-4), (1.4, 3e-4), (1.8, 6e-4)):
        wave = weights @ np.exp(1j * k * nodes)
        assert np.abs(wave - np.exp(1j * k * offset)).max() < error
    assert np.abs(weights @ np.cos(np.pi * nodes)).max() < 0.01


def test_grid_puts_floor_microphone_and_image_on_nodes(box):
    microphone = np.array([0.2, -0.6, 0.217])
    grid = room_grid.room_grid(microphone, box, 0.03, FLOOR_Z_M)
    source, image = (grid.origin + grid.spacing_m * np.array(n) for n in grid.source_nodes)
    np.testing.assert_allclose(source, microphone, atol=1e-12)
    np.testing.assert_allclose(image, [0.2, -0.6, 2 * FLOOR_Z_M - 0.217], atol=1e-12)
    assert (grid.source_nodes[0][2] - grid.source_nodes[1][2]) % 2 == 0
    assert grid.spacing_m <= 0.03
    for count, part in zip(grid.shape, grid.block, strict=True):
        assert part.start >= room_grid.PML_NODES
        assert part.stop <= count - room_grid.PML_NODES


@pytest.mark.parametrize(
    ("microphone", "message"),
    [
        ((0.0, 0.0, 0.0), "m off the box around the shell"),
        ((0.15, 0.0, 0.0), "m off the box around the shell"),
        ((0.5, 0.0, -0.2), "lies below the floor"),
    ],
)
def test_impossible_microphones_are_refused(box, microphone, message):
    with pytest.raises(ParameterError, match=message):
        simulated(box, microphone)


def test_memory_is_checked_before_the_run(box, monkeypatch):
    monkeypatch.setattr("psutil.virtual_memory", type("M", (), {"available": 2**20}))
    with pytest.raises(
        ParameterError, match=r"room_spacing_mm: the k-Wave grid of .* GiB are avail"
    ):
        simulated(box, (0.5, 0.0, 0.0))


def test_importing_and_running_kwave_touches_no_network():
    """k-Wave's own package import would download executables."""
    script = textwrap.dedent("""
        import socket, sys
        class Refused(socket.socket):
            def __init__(self, *arguments, **options):
                raise RuntimeError("network")
        socket.socket = Refused
        import numpy as np
        from vibroacoustics.radiation import kwave, room_grid
        from vibroacoustics.radiation.box import closed_box
        assert "kwave" not in sys.modules
        box = closed_box(np.full(3, -0.1), np.full(3, 0.1), 0.05, False)
        grid = room_grid.room_grid(np.array([0.5, 0.0, 0.0]), box, 0.1, None)
        simulation = kwave.build_simulation(grid, np.array([1.0, -1.0]), 3)
        simulation.step()
        assert np.abs(simulation.p).max() > 0
        assert not hasattr(sys.modules["kwave"], "install_binaries")
        assert "cv2" not in sys.modules
        print("done")
    """)
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=120, check=False
    )
    assert result.stdout.strip() == "done", result.stderr
