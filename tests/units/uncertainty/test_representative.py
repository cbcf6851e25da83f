"""Choice of the representative sample, by hand and in a run."""

from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from sources_study import sources_run

from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.levels.bands import Band
from vibroacoustics.levels.contributions import PathEnergies
from vibroacoustics.mechanics.contributions import PathName
from vibroacoustics.uncertainty.path_variables import path_variables
from vibroacoustics.uncertainty.representative import nearest_row

OPTIONS = ["none", "loud"]


def made_up(levels, unmodelled, weight, receivers=1):
    """Two sources of samples without an option, louder by 40 dB with one; medians are 50 dB."""
    levels = np.asarray(levels, dtype=float)  # (sample, source)
    place = {"speed": [1.0], "option": OPTIONS, "receiver": [str(n) for n in range(receivers)]}
    of_options = np.stack([levels, levels + 40.0], axis=1)
    by_sample = np.repeat(of_options[:, None, :, :, None], receivers, axis=-1)
    median = np.full(by_sample.shape[1:], 50.0)
    dims = ("speed", "option", "sound_source", "receiver")
    return xr.Dataset(
        {
            "source_level": (dims, median),
            "source_level_by_sample": (("sample", *dims), by_sample),
            "level_total": (("speed", "option", "receiver"), np.full((1, 2, receivers), 55.0)),
            "level_unmodelled": 50.0,
            "level_unmodelled_by_sample": ("sample", np.asarray(unmodelled, dtype=float)),
            "sample_weight": (("prior", "sample"), [weight, weight]),
        },
        {**place, "sound_source": ["a", "b"]},
    )


def test_the_nearest_of_the_samples_is_chosen():
    """Squares without an option: 8, 10 and 9."""
    levels = [[52.0, 52.0], [53.0, 49.0], [50.0, 47.0]]
    assert nearest_row(made_up(levels, [50.0] * 3, [1.0] * 3)) == 0
    assert nearest_row(made_up(levels, [52.0, 50.0, 50.0], [1.0] * 3)) == 2
    assert nearest_row(made_up(levels, [52.0, 50.0, 52.0], [1.0] * 3)) == 1


def test_samples_without_weight_are_not_chosen():
    levels = [[50.0, 50.0], [53.0, 50.0], [54.0, 50.0]]
    assert nearest_row(made_up(levels, [50.0] * 3, [0.0, 1.0, 1.0])) == 1


def test_unmodelled_noise_counts_at_every_microphone():
    """Sources 2 dB off at each, or noise 2.5 dB off: 8 to 6.25 by microphone."""
    levels = [[52.0, 52.0], [50.0, 50.0]]
    for receivers in (1, 3):
        results = made_up(levels, [50.0, 52.5], [1.0, 1.0], receivers)
        assert nearest_row(results) == 1
        results = made_up(levels, [50.0, 53.0], [1.0, 1.0], receivers)
        assert nearest_row(results) == 0


def test_sources_that_nobody_hears_do_not_count():
    """More than 30 dB below the machine."""
    levels = [[50.0, 50.0], [51.0, 50.0]]
    results = made_up(levels, [50.0, 50.0], [1.0, 1.0])
    quiet = results.copy(deep=True)
    quiet["source_level"].loc[{"sound_source": "b"}] = 24.0
    quiet["source_level_by_sample"].loc[{"sound_source": "b"}] = xr.DataArray(
        [0.0, 24.0], dims="sample"
    )
    assert nearest_row(quiet) == 0
    quiet["source_level"].loc[{"sound_source": "b"}] = 26.0
    assert nearest_row(quiet) == 1


@pytest.fixture(scope="module")
def results():
    return sources_run()


def test_values_of_a_run_are_those_of_the_nearest_row(results):
    row = nearest_row(results)
    np.testing.assert_array_equal(
        results["representative_value"], results["sampled_value"].isel(sample=row)
    )


def test_sound_of_a_run_is_that_of_its_row_but_for_the_orders(results):
    """Lines without interference of options: each source alone, orders apart, and noise."""
    row = nearest_row(results)
    at = {"speed": 2900.0, "option": "none", "receiver": "front_1m"}
    (rest,) = np.atleast_1d(results["level_unmodelled_by_sample"].isel(sample=row).values)
    bands = results["representative_unmodelled_band_level"].sel(at)
    weighted = bands + a_weighting(10.0 ** (np.rint(10.0 * np.log10(bands["noise_band"])) / 10.0))
    assert 10.0 * np.log10((10.0 ** (weighted / 10.0)).sum()) == pytest.approx(rest, abs=1e-6)
    motor = results["source_level_by_sample"].isel(sample=row).sel(at).sel(sound_source="motor")
    lines = results["pressure_line"].sel(at).sel(sound_source="motor")
    hertz = results["tone_frequency"].sel(speed=2900.0).values
    sounds = hertz > 0.0
    square = 0.5 * np.abs(lines.values[sounds]) ** 2
    level = square @ 10.0 ** (a_weighting(hertz[sounds]) / 10.0) / 4e-10
    assert 10.0 * np.log10(level) == pytest.approx(motor.item(), abs=1e-6)


def test_paths_are_those_of_the_samples(results):
    """Levels of third octaves are medians of all samples; shares of each order add up to one."""
    speeds = results["path_speed"].values
    medians = results["sources_band_level"].sel(option="none", speed=speeds)
    bands = [band for band in results["band"].values if band in medians["noise_band"]]
    expected = medians.sel(noise_band=bands).transpose("speed", "receiver", "noise_band").values
    found = results["modelled_band_level"].sel(band=bands)
    found = found.transpose("path_speed", "receiver", "band").values
    sounds = expected > -200.0
    np.testing.assert_allclose(found[sounds], expected[sounds], atol=1e-4)
    for name in ("path_share", "path_order_share", "path_band_share"):
        total = results[name].sum("path").values
        np.testing.assert_allclose(total[total != 0.0], 1.0, rtol=1e-5)
    low, high = (results[f"path_share_{end}_percent"] for end in (10, 90))
    assert (low <= results["path_share"]).mean() > 0.9
    assert (results["path_share"] <= high).mean() > 0.9


def test_a_single_path_is_in_phase_with_the_sum():
    """Of one path the share is one and the cosine +1; opposite ones have -1."""
    rows = [{2900.0: energies_of([2.0 + 1.0j])}]
    axes = NominalAxes(("front_1m",), ())
    alone = path_variables(axes, [1], [rows])
    assert alone["path_share"].item() == pytest.approx(1.0)
    assert alone["path_cosine"].item() == pytest.approx(1.0)
    two = [{2900.0: energies_of([3.0, -1.0])}]
    both = path_variables(axes, [1], [two])
    np.testing.assert_allclose(both["path_cosine"].values.ravel(), [1.0, -1.0], rtol=1e-6)
    np.testing.assert_allclose(both["path_share"].values.ravel(), [1.5, -0.5], rtol=1e-6)
    mixed = path_variables(axes, [1], [rows, two], [3, 1])
    np.testing.assert_allclose(mixed["path_share"].values.ravel(), [1.125, -0.125], rtol=1e-6)


class NominalAxes(NamedTuple):
    receivers: tuple[str, ...]
    bands: tuple[Band, ...]


def energies_of(pressure):
    """Energies of paths of one line at one microphone."""
    phasor = np.array(pressure)[:, None, None]
    part = (phasor * phasor.sum(axis=0).conj()).real
    path = 0.5 * np.stack([np.abs(phasor) ** 2, part])
    names = tuple(PathName("gas", "housing", f"t{n}") for n in range(len(pressure)))
    return PathEnergies(names, ("tx",), np.concatenate([path, path], axis=-1), path[:, :1, :, 0])
