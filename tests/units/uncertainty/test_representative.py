"""Choice of the representative sample, by hand and in a run."""

import numpy as np
import pytest
import xarray as xr
from sources_study import sources_run

from vibroacoustics.base.weighting import a_weighting
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


def test_paths_have_the_levels_of_the_medians(results):
    """Each order, each third octave and in all; shares add up to one."""
    paths = results.sel(option="none").transpose("path_speed", "receiver", ...)
    medians = results.sel(option="none", speed=paths["path_speed"].values).transpose(
        "speed", "receiver", ...
    )
    order = medians["order_level"].sel(weighting="Z", order=paths["path_order"].values).values
    pressure = np.abs(paths["path_pressure"].sum("path").values)
    np.testing.assert_allclose(20.0 * np.log10(pressure / np.sqrt(8.0) / 1e-5), order, atol=1e-6)
    bands = [band for band in paths["band"].values if band in medians["noise_band"]]
    expected = medians["sources_band_level"].sel(noise_band=bands).values
    found = paths["modelled_band_level"].sel(band=bands).values
    sounds = expected > -200.0
    np.testing.assert_allclose(found[sounds], expected[sounds], atol=1e-4)
    np.testing.assert_allclose(paths["path_share"].sum("path"), 1.0, rtol=1e-9)
    np.testing.assert_allclose(paths["motion_share"].sum("radiating_motion"), 1.0, rtol=1e-9)


def test_parts_of_third_octaves_add_up_to_the_median_of_the_machine(results):
    """The stack of the picture, A-weighted within a band, beside the level of the machine."""
    at = {"speed": float(results["shown_speed"]), "option": results["shown_option"].values}
    energy = results["band_energy"].sum("energy_part").rename(shown_option="option")
    level = 10.0 * np.log10(np.maximum(energy, 1e-40) / 4e-10)
    total = results["total_band_level"].sel(at)
    hertz = 10.0 ** (np.rint(10.0 * np.log10(total["noise_band"])) / 10.0)
    ends = [a_weighting(hertz * 10.0**end) for end in (-0.05, 0.05)]  # a line lies in its band
    apart = (level - total).where((total > -100.0) & (hertz < 2000.0))
    assert apart.count() > 40
    assert not (apart < ends[0] - 0.01).any()
    assert not (apart > ends[1] + 0.01).any()


def test_shares_by_source_are_those_of_its_paths(results):
    """One machine: what a picture gives each source, its transfer paths give it, too."""
    at = {"receiver": "front_1m"}
    energy = results["line_energy"].sel(at).sel(shown_option="none")
    speed = float(results["shown_speed"])
    pressure = results["path_pressure"].sel(at).sel(option="none", path_speed=speed)
    part = (pressure * np.conj(pressure.sum("path"))).real
    for number, order in enumerate(pressure["path_order"].values):
        line = energy.sel(line=energy["line_order"] == order).squeeze("line")
        if float(line.sum()) == 0.0:
            continue
        share = part.isel(path_order=number).groupby("path_source").sum()
        share = share / share.sum()
        expected = (line / line.sum()).sel(sound_source=share["path_source"].values)
        np.testing.assert_allclose(share.values, expected.values, atol=1e-6)
