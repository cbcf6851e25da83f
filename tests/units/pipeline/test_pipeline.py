"""The stages together, with made-up transfer vectors in place of the radiation step."""

import numpy as np
import pytest
import xarray as xr
from support import ROOT, made_up_radiation, made_up_transfer_vectors

from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import SUFFIXES, VARIABLES
from vibroacoustics.orders import semi_major_axis
from vibroacoustics.results import storage
from vibroacoustics.study.loading import load_study

ROUNDING = 1e-12
STUDIES = ROOT / "tests" / "studies"
OF_SOURCES = {
    "projection_error",
    "supply_frequency",
    "decisive_audibility_by_sample",
    "rating_level_by_sample",
    "source_level_by_sample",
    "level_modelled_by_sample",
    "level_total_by_sample",
    "level_unmodelled_by_sample",
    "sample_weight",
    "datum_value",
    "datum_deviation",
    "datum_expected",
    "datum_tail",
    "model_level",
    "conflict_tail",
    "alternative_share",
    "alternative_level",
    "alternative_effective",
    "representative_value",
    "representative_noise_band_level",
    "representative_unmodelled_band_level",
    "rating_level",
    "rating_adjustment",
    "rating_limit",
    "limit_probability",
    "sampled_value",
    "prior_sample_weight",
    "choice_utility",
    "perfect_information",
    "parameter_information",
    "parameter_information_votes",
    "parameter_information_floor",
    "level_share",
    "level_share_low",
    "level_share_high",
    "level_share_floor",
    "force_1x_by_sample",
    "moment_1x_by_sample",
    "foot_force_1x_by_sample",
    "prior_sample_level",
    "prior_sample_value",
    "stopping_duration",
    "stopping_revolutions",
    "stopping_shaft_speed",
    "stopping_force",
    "stopping_moment",
    "stopping_pressure",
    "stopping_fast_level",
    "stopping_fast_maximum_level",
    "stopping_peak_level",
    "stopping_foot_force",
    "stopping_order_map",
    "stopping_brake_force",
    "stopping_turned_back_angle",
}
NOT_MADE_HERE = {
    "block_velocity_order",
    "spring_displacement",
    "loudness_in_room",
    "green_difference",
    "pattern_transfer_vector",
    "pattern_transfer_vector_error",
    "map_level",
    "order_sound_power_level",
    "sound_power_level",
    "given_value",
    "column_value",  # of third parties only
    "option_natural_frequency",  # with attached bodies
    "option_mode_energy",
    "option_mount_transmissibility",
    "baseline_share",  # with a measured baseline
    "baseline_band_level",
    "baseline_order_level",
    "baseline_order_phase",
    "baseline_order_pressure",
    "baseline_order_share",
    "truncation",  # of measurements alone
    "truncation_error",
    "condition_number",
    "left_out_error",
    "spread_value",  # of a search of designs
    "map_transfer_vector",
    "directivity_transfer_vector",
    "surface_transfer_vector",
    "unit_sound_power_level",
}


OF_OTHER_JOBS = (
    "predicted_", "blocked_", "validation_", "inversion_", "shell_", "best_design",
    "structure_borne_", "level_both_ways", "gas_frequency", "room_", "hemisphere_",
    "measured_", "background_", "mean_position_", "environment_", "slider_", "polar_",
    "spectrum_", "run_speed", "machines_", "machine_", "beat_", "base_", "alternative_",
)  # fmt: skip
"""Of measurements, a test of the shell, a search of designs, a plate, gas, a room, sliders, several
machines, changed inputs."""


@pytest.fixture(scope="module")
def results(thesis_study) -> xr.Dataset:
    return pipeline.run(thesis_study, radiation=made_up_radiation)


def test_run_makes_the_whole_vocabulary(results):
    of_recordings = {
        name for name, variable in VARIABLES.items() if {"channel", "fault"} & set(variable.dims)
    }
    elsewhere = NOT_MADE_HERE | of_recordings | OF_SOURCES
    elsewhere |= {name for name in VARIABLES if name.startswith(OF_OTHER_JOBS)}
    elsewhere |= {name for name in VARIABLES if name.endswith(tuple(SUFFIXES.values()))}
    elsewhere |= {
        name for name, variable in VARIABLES.items() if {"design", "wanted"} & set(variable.dims)
    }
    assert set(results.data_vars) >= set(VARIABLES) - elsewhere
    for name, array in results.data_vars.items():
        if name != "reported_figure":  # a figure that an option does not have is NaN
            assert np.all(np.isfinite(array)), name


def test_sums_over_source_are_the_totals(results):
    """Every resultant and every pressure is the sum of its sources."""
    force = results["force_order"].sum("source").transpose("speed", "option", "axis", "order")
    np.testing.assert_allclose(
        results["force_amplitude"], semi_major_axis(force.values, axis=2), rtol=ROUNDING
    )
    pressure = np.abs(results["pressure_line"].sum("sound_source")) / np.sqrt(2.0)
    first = 20.0 * np.log10(pressure.sel(line="order 1") / 20e-6)
    line = results["order_level"].sel(order=1, weighting="Z")
    np.testing.assert_allclose(line, first.transpose(*line.dims), atol=1e-9)


def test_order_0_of_the_motion_is_rest(results):
    assert not results["velocity_order"].sel(order=0).values.any()


def test_changes_of_none_are_zero(results):
    for name in ("change_1x", "change_modelled", "change_total"):
        assert not results[name].sel(option="none").values.any(), name


def test_damping_changes_nothing(results):
    none, damped = (results.sel(option=name, drop=True) for name in ("none", "damping"))
    for name in ("force_order", "velocity_order", "foot_force_order", "level_total"):
        np.testing.assert_array_equal(none[name], damped[name])


def test_catalogue_level_comes_out_where_it_was_measured(results, thesis_study):
    total = results["level_total"].sel(
        option="none", speed=2900.0, receiver=thesis_study.catalogue_receiver
    )
    assert total == pytest.approx(56.0, abs=1e-9)


def test_total_is_never_below_the_modelled_level(results):
    assert np.all(results["level_total"] >= results["level_modelled"].sel(weighting="A"))
    published = results["level_total"].sel(receiver="front_1m")
    assert np.all(published >= results["level_unmodelled"])


def test_change_of_the_total_is_smaller_than_that_of_the_modelled_level(results):
    """A constant remainder only hides."""
    slack = 1e-9
    assert np.all(abs(results["change_total"]) <= abs(results["change_modelled"]) + slack)


def test_halved_force_is_6_db_at_most(results):
    """counterweight-half turns half of the x force into y: foot forces stay below the bare ones."""
    foot = results["foot_force_amplitude"].sel(order=1).max("foot")
    assert np.all(foot.sel(option="counterweight-half") < foot.sel(option="none"))


def test_results_survive_the_disk(results, tmp_path):
    again = storage.open_results(storage.write_results(results, tmp_path / "results.nc"))
    xr.testing.assert_identical(results, again[list(results.data_vars)])


def test_model_louder_than_the_catalogue_is_refused(thesis_study):
    loud = (made_up_transfer_vectors(thesis_study, gain=1e6), False)
    with pytest.raises(ParameterError, match=r"overall_noise\.level_dba = 56 dB\(A\)"):
        pipeline.run(thesis_study, radiation=lambda *_: loud)


def test_radiation_alone_tells_where_it_comes_from(thesis_study):
    made = made_up_transfer_vectors(thesis_study)
    radiated = pipeline.radiate(thesis_study, radiation=lambda *_: (made, True))
    assert set(radiated.data_vars) == set(made.data_vars)
    assert radiated.attrs["transfer_vectors"] == "from the cache"
    assert radiated.attrs["title"] == thesis_study.title
    assert "made up" in radiated.attrs["radiation"]
    assert radiated["frequency"].attrs["units"] == "Hz"


def test_radiation_refuses_in_the_name_of_the_study(thesis_study):
    def refuse(*_):
        raise ParameterError("receivers.a: too close")

    with pytest.raises(ParameterError, match=r"copeland_thesis\.toml: receivers\.a: too close"):
        pipeline.radiate(thesis_study, radiation=refuse)


@pytest.fixture(scope="module")
def field_study():
    return load_study(STUDIES / "field.toml")


@pytest.fixture(scope="module")
def field(field_study):
    return pipeline.run(field_study)


@pytest.mark.long
def test_radiation_alone_is_what_the_run_uses(field, field_study):
    alone = pipeline.radiate(field_study)
    assert alone.attrs["transfer_vectors"] == "from the cache"
    for name in ("transfer_vector", "map_transfer_vector", "directivity_transfer_vector"):
        np.testing.assert_array_equal(alone[name], field[name])
    # Free of k-Wave there is nothing to compare.
    assert not {"transfer_vector_closed_form", "green_difference", "line_difference"} & set(field)


def test_map_is_the_contraction_of_line_and_transfer_vector(field):
    """By hand at one point, of the 1x line of the option `none`."""
    velocity = field["velocity_order"].sel(order=1, option="none").isel(speed=0).sum("source")
    vectors = field["map_transfer_vector"].isel(line_frequency=0, map_row=2, map_column=0)
    peak = abs((velocity * vectors).sum("dof")).item()
    level = field["map_level"].sel(option="none").isel(speed=0, map_row=2, map_column=0)
    assert level.item() == pytest.approx(20.0 * np.log10(peak / np.sqrt(2.0) / 20e-6), abs=1e-9)


def test_map_is_blank_in_the_machine_only(field):
    """Boundary elements have a pressure everywhere else, under the machine as well."""
    x, z = field["map_x"], field["map_z"]
    blank = np.isnan(field["map_level"].sel(option="none").isel(speed=0)).values
    machine = (abs(x) < 0.08) & (abs(z) < 0.19)
    assert machine.any()
    np.testing.assert_array_equal(blank, machine.values)


def test_sound_power_falls_with_the_force(field):
    """Half a counterweight halves the force of the ring: the 1x line loses sound power."""
    power = field["order_sound_power_level"].sel(order=1, weighting="Z").isel(speed=0)
    gain = (power.sel(option="counterweight-half") - power.sel(option="none")).item()
    assert -12.0 < gain < -2.0
