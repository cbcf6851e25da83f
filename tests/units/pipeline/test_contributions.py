"""Sound by path: paths add up to what all sources make, whatever the machine."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, run_made_up
from support import PIPELINES, made_up_transfer_vectors, tiny_run

from vibroacoustics import pipeline
from vibroacoustics.base.decibel import power_of_level
from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.contributions import contribution_variables
from vibroacoustics.results.estimates import nominal
from vibroacoustics.stages import paths
from vibroacoustics.study.loading import load_study


def without_samples(study):
    """The study with nominal values alone."""
    return study.model_copy(update={"ranges": ()})


@pytest.fixture
def results():
    return run_made_up(without_samples(load_study(SOURCES_STUDY)))


@pytest.fixture(autouse=True)
def motions_add_up(monkeypatch):
    """In every run here what radiates is what the paths bring, line by line, to 1e-9."""

    def checked(axes, cases, orders, medians=None):
        for split in cases.values():
            total = split.pressure.sum(axis=0)
            limit = 1e-9 * np.abs(total).max()
            np.testing.assert_allclose(split.by_motion.sum(axis=(0, 1)), total, atol=limit)
        return contribution_variables(axes, cases, orders, medians)

    monkeypatch.setattr(paths, "contribution_variables", checked)


def assert_adds_up(results):
    """Phasors of the paths are the sources' to 1e-9, their energies to the levels."""
    orders = results["path_order"].values.astype(int)
    speeds = results["path_speed"].values
    paths = results["path_pressure"].sum("path").values
    every = nominal(results, "pressure_line").sel(speed=speeds).isel(line=orders)
    lines = every.sum("sound_source")
    np.testing.assert_allclose(paths, lines.values, atol=1e-9 * np.abs(lines).max().item())
    for source, of_source in results["path_pressure"].groupby("path_source"):
        line = every.sel(sound_source=source)
        np.testing.assert_allclose(
            of_source.sum("path").values, line.values, atol=1e-9 * np.abs(line).max().item()
        )
    np.testing.assert_allclose(results["path_share"].sum("path"), 1.0, rtol=1e-9)
    np.testing.assert_allclose(results["motion_share"].sum("radiating_motion"), 1.0, rtol=1e-9)
    modelled = power_of_level(nominal(results, "level_modelled").sel(speed=speeds, weighting="A"))
    total = power_of_level(nominal(results, "level_total").sel(speed=speeds))
    shares = results["path_share"].groupby("path_source").sum()
    expected = nominal(results, "source_share").sel(speed=speeds)
    for source in shares["path_source"].values:
        part = (shares.sel(path_source=source) * modelled.rename(speed="path_speed")).values
        other = (expected.sel(sound_source=source) * total).values
        np.testing.assert_allclose(part, other, atol=1e-9 * modelled.max().item())


@pytest.mark.long
def test_paths_of_several_sources_add_up(results):
    assert_adds_up(results)
    assert {"housing", "stator", "bearing_housing"} <= set(results["path_port"].values)
    assert np.sum(results["path_source"].values == "keys") > 1  # which strike: noise
    bands = results["path_band_share"].sum("path").values
    np.testing.assert_allclose(bands[bands != 0.0], 1.0, rtol=1e-9)

    check_single_paths(results)


def check_single_paths(results):
    """A path of the moving parts is a transfer vector times the velocity of its motion."""
    alone = results["path_level"].groupby("path_source").count("path")
    assert (alone > 1).all()
    moving = results.isel(path=(results["path_source"] == "moving_parts").values)
    assert set(moving["path_port"].values) == {"housing"}
    pressure = moving["path_pressure"].sel(path="moving_parts: housing tx").sel(path_order=1.0)
    velocity = results["velocity_order"].sel(dof="tx", order=1).sum("source")
    vector = results["transfer_vector"].sel(dof="tx")
    hertz = results["order_frequency"].sel(order=1).item()
    ratio = (pressure / velocity.rename(speed="path_speed")).sel(option=REFERENCE_OPTION)
    between = vector.sel(frequency=slice(hertz - 25.0, hertz + 25.0))
    low, high = np.abs(between).min("frequency"), np.abs(between).max("frequency")
    assert ((np.abs(ratio) > low) & (np.abs(ratio) < high)).all()


def shortened(name, **more):
    """A study at its first speed."""
    study = load_study(PIPELINES / f"{name}.toml")
    supply = study.operation.supply_frequency_hz
    operation = {"operation.speed_rpm": [study.operation.speed_rpm[0]]}
    if supply:
        operation["operation.supply_frequency_hz"] = [supply[0]]
    loud = {"machine.overall_noise.level_dba": {"value": 90.0, "source": "test"}}
    return without_samples(study.replace({**operation, **loud, **more}))


@pytest.mark.parametrize(
    "name",
    [
        "zhao_minicrank",
        "reciprocating_table",
        "mayekawa_wbhe",
        pytest.param("dagilis_slider_link", marks=pytest.mark.long),
        pytest.param("estupinan_hermetic", marks=pytest.mark.long),
        pytest.param("thesis_table_3", marks=pytest.mark.long),
    ],
)
def test_paths_of_every_rigid_machine_add_up(name):
    def radiation(study, *_):
        return made_up_transfer_vectors(study, 0.01), False

    assert_adds_up(pipeline.run(shortened(name), radiation=radiation))


@pytest.mark.long
@pytest.mark.parametrize(
    "name", ["copeland_sources", "copeland_inverter", "dagilis_sources", "estupinan_sources"]
)
def test_paths_through_frame_yoke_and_gas_add_up(name):
    samples = {"uncertainty.random_samples": 4}
    results = run_made_up(shortened(name, **samples), gain=0.01)
    assert_adds_up(results)


def test_paths_are_behind_the_insertion_loss_of_an_option():
    hood = 'kind = "hood"\nband_hz = [50.0, 100.0]\ninsertion_loss_db = [6.0, 20.0]\n'
    results = tiny_run(f"[options.hood]\n{hood}")
    assert_adds_up(results)
    level = results["path_level"].max("path").sel(option=["none", "hood"]).squeeze()
    assert np.diff(level).item() < -6.0 + 1e-6
