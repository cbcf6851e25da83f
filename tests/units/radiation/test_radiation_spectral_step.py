"""The fused time step against k-Wave's own."""

from contextlib import closing
from functools import cache

import numpy as np
import pytest

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.radiation import device, kwave, spectral_layout, spectral_step
from vibroacoustics.radiation.room_grid import RoomGrid
from vibroacoustics.radiation.spectral_step import PressureSource, SpectralStep

STEPS = 60
SPACING_M = np.array([0.03, 0.025, 0.04])
EVEN_AND_ODD = (32, 27, 36)
SHAPES = [(32, 30, 36), (27, 45, 25), EVEN_AND_ODD, (25, 36, 27)]
"""Even, odd and mixed lengths; 16 nodes of each are absorbing."""
ONE, SEVERAL = {(12, 11, 13): 1.0}, {(12, 11, 13): 1.0, (12, 11, 16): -0.7, (14, 15, 12): 0.3}


@pytest.fixture(autouse=True)
def thin_layer(monkeypatch):
    """A thinner absorbing layer keeps grids small."""
    monkeypatch.setattr(kwave, "PML_NODES", 8)


def grid_and_source(shape, strengths):
    grid = RoomGrid(
        SPACING_M, np.zeros(3), shape, tuple(strengths), np.array(list(strengths.values())),
        (slice(3, 9), slice(2, 12), slice(4, 11)),
    )  # fmt: skip
    signal = np.sin(np.arange(20.0) / 3) * np.hanning(20)
    return grid, PressureSource(grid.source_nodes, grid.source_strengths, signal)


def fused(grid, source, dtype=np.float64, threads=2):
    return SpectralStep(
        kwave.axis_operators(grid),
        grid.time_step_s,
        SPEED_OF_SOUND_M_PER_S,
        AIR_DENSITY_KG_PER_M3,
        source,
        dtype,
        threads,
    )


def stock(grid, source, namespace=None, dtype=np.float64):
    simulation = kwave.build_simulation(grid, source, STEPS, namespace, dtype)
    return kwave.StockEngine(simulation)


def on_device(grid, source):
    if device.array_namespace() is np:
        pytest.skip("no CuPy or no device")
    return stock(grid, source, device.array_namespace())


def scipy_slabs(grid, source):
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(spectral_step, "slab_type", lambda: spectral_layout.ScipySlab)
        return fused(grid, source)


def run(engine, shape):
    """Pressure after the run and the largest pressure of all steps."""
    everywhere, largest = tuple(slice(0, count) for count in shape), 0.0
    for _ in range(STEPS):
        engine.step()
        pressure = engine.pressure(everywhere)
        largest = max(largest, np.abs(pressure).max())
    engine.close()
    return pressure, largest


@cache
def untouched(shape, several):
    """The same of k-Wave's own step, which all others are held against."""
    return run(stock(*grid_and_source(shape, SEVERAL if several else ONE)), shape)


@pytest.mark.parametrize("several", [False, True], ids=["one-source", "several-sources"])
@pytest.mark.parametrize(
    "shape",
    [pytest.param(one, marks=[pytest.mark.long] * (one != EVEN_AND_ODD)) for one in SHAPES],
    ids=str,
)
@pytest.mark.parametrize(
    "build",
    [fused, scipy_slabs, lambda grid, source: stock(grid, source, np), on_device],
    ids=["fftw", "scipy", "stock-half-spectra", "device"],
)
def test_step_equals_the_untouched_step(build, shape, several):
    """1e-12 of the largest pressure, with most of the wave in the absorbing layer by then."""
    expected, largest = untouched(shape, several)
    pressure, _ = run(build(*grid_and_source(shape, SEVERAL if several else ONE)), shape)
    interior = tuple(slice(8, -8) for _ in shape)
    assert 1e-4 * largest < np.abs(expected[interior]).max() < 0.1 * largest
    np.testing.assert_allclose(pressure, expected, rtol=0, atol=1e-12 * largest)


@pytest.mark.parametrize("shape", SHAPES[:2], ids=str)
@pytest.mark.long
def test_single_precision_adds_rounding_alone(shape):
    """Each step rounds a few numbers; if all errors added up: steps times epsilon."""
    expected, largest = untouched(shape, True)
    pressure, _ = run(fused(*grid_and_source(shape, SEVERAL), np.float32), shape)
    assert pressure.dtype == np.float32
    np.testing.assert_allclose(
        pressure, expected, rtol=0, atol=STEPS * np.finfo(np.float32).eps * largest
    )


def test_threads_and_slabs_change_no_bit(monkeypatch):
    grid, source = grid_and_source(SHAPES[0], SEVERAL)
    expected, _ = run(fused(grid, source, threads=1), grid.shape)
    monkeypatch.setattr(spectral_step, "_SLAB_BYTES", 2**15)
    for threads in (1, 3):
        np.testing.assert_array_equal(run(fused(grid, source, threads=threads), grid.shape)[0],
                                      expected)  # fmt: skip


def test_a_block_is_a_part_of_the_whole():
    grid, source = grid_and_source(SHAPES[1], SEVERAL)
    with closing(fused(grid, source)) as engine:
        for _ in range(12):
            engine.step()
        whole = engine.pressure()
        assert whole.shape == grid.shape
        np.testing.assert_allclose(
            engine.pressure(grid.block), whole[grid.block], rtol=0, atol=1e-15 * np.abs(whole).max()
        )


def test_fftw_is_used_where_it_is_installed(monkeypatch):
    assert spectral_layout.slab_type() is spectral_layout.FftwSlab
    monkeypatch.setitem(__import__("sys").modules, "pyfftw", None)
    assert spectral_layout.slab_type() is spectral_layout.ScipySlab


@pytest.mark.parametrize("slab", [spectral_layout.FftwSlab, spectral_layout.ScipySlab])
@pytest.mark.parametrize("line_axis", [1, 2])
def test_slabs_transform_their_lines(slab, line_axis):
    lines = slab((2, 9, 10), line_axis, np.complex64)
    values = np.random.default_rng(1).normal(size=(2, 9, 10)).astype(np.complex64)
    lines.position[...] = values
    lines.to_wavenumber()
    np.testing.assert_allclose(lines.wavenumber, np.fft.fft(values, axis=line_axis), atol=1e-5)
    lines.to_position()
    np.testing.assert_allclose(lines.position, values * values.shape[line_axis], atol=1e-4)


def test_an_axis_of_k_wave_times_the_correction_is_k_wave():
    """What the engine relies on: symbols of three dimensions are products."""
    grid, source = grid_and_source(SHAPES[0], ONE)
    whole = kwave.build_simulation(grid, source, 2)
    for number, axis in enumerate(kwave.axis_operators(grid)):
        line = [1, 1, 1]
        line[number] = -1
        for full, symbol in (
            (whole.op_grad_list[number], axis.gradient),
            (whole.op_div_list[number], axis.divergence),
        ):
            np.testing.assert_allclose(
                full, whole.kappa * symbol.reshape(line), rtol=0, atol=1e-13 * np.abs(full).max()
            )
