"""Sound by path: paths add up to what all sources make, whatever the machine."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, run_made_up
from support import PIPELINES, made_up_transfer_vectors

from vibroacoustics import pipeline
from vibroacoustics.base.decibel import power_of_level
from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.levels.contributions import path_rows
from vibroacoustics.results.estimates import nominal
from vibroacoustics.stages import paths
from vibroacoustics.study.loading import load_study

SINGLE = 1e-6
"""Error of a sum of energies in single precision."""


def without_samples(study):
    """The study with nominal values alone."""
    return study.model_copy(update={"ranges": ()})


@pytest.fixture
def results():
    return run_made_up(without_samples(load_study(SOURCES_STUDY)))


@pytest.fixture(autouse=True)
def cases(monkeypatch):
    """Contributions of every run here; what radiates is what the paths bring, to 1e-9."""
    kept = {}

    def checked(every, gain, axes, orders):
        every = dict(every)
        for split in every.values():
            total = split.pressure.sum(axis=0)
            limit = 1e-9 * np.abs(total).max()
            np.testing.assert_allclose(split.by_motion.sum(axis=(0, 1)), total, atol=limit)
        kept.update(every)
        return path_rows(every.items(), gain, axes, orders)

    monkeypatch.setattr(paths, "path_rows", checked)
    return kept


def assert_adds_up(results, cases):
    """Phasors of the paths are the sources' to 1e-9, their energies to the levels."""
    orders = results["path_order"].values.astype(int)
    speeds = results["path_speed"].values
    assert [*cases] == [(speed, REFERENCE_OPTION) for speed in speeds]
    for (speed, option), split in cases.items():
        every = nominal(results, "pressure_line").sel(speed=speed, option=option)
        every = every.isel(line=orders).transpose("sound_source", "receiver", "line")
        limit = 1e-9 * np.abs(every.sum("sound_source")).max().item()
        for source in split.sources:
            rows = [number for number, name in enumerate(split.names) if name.source == source]
            of_source = split.pressure[rows][..., orders].sum(axis=0)
            line = every.sel(sound_source=source).values
            np.testing.assert_allclose(of_source, line, atol=limit)
    np.testing.assert_allclose(results["path_share"].sum("path"), 1.0, rtol=SINGLE)
    np.testing.assert_allclose(results["motion_share"].sum("radiating_motion"), 1.0, rtol=SINGLE)
    at = {"speed": speeds, "option": REFERENCE_OPTION}
    modelled = power_of_level(nominal(results, "level_modelled").sel(at).sel(weighting="A"))
    total = power_of_level(nominal(results, "level_total").sel(at))
    shares = results["path_share"].groupby("path_source").sum()
    expected = nominal(results, "source_share").sel(at)
    for source in shares["path_source"].values:
        part = shares.sel(path_source=source) * modelled.rename(speed="path_speed")
        other = (expected.sel(sound_source=source) * total).rename(speed="path_speed")
        limit = SINGLE * modelled.max().item()
        np.testing.assert_allclose(part, other.transpose(*part.dims), atol=limit)


@pytest.mark.long
def test_paths_of_several_sources_add_up(results, cases):
    assert_adds_up(results, cases)
    assert {"housing", "stator", "bearing_housing"} <= set(results["path_port"].values)
    assert np.sum(results["path_source"].values == "keys") > 1  # which strike: noise
    bands = results["path_band_share"].sum("path").values
    np.testing.assert_allclose(bands[bands != 0.0], 1.0, rtol=SINGLE)
    check_single_paths(results, cases)


def check_single_paths(results, cases):
    """A path of the moving parts is a transfer vector times the velocity of its motion."""
    alone = results["path_level"].groupby("path_source").count("path")
    assert (alone > 1).all()
    moving = results.isel(path=(results["path_source"] == "moving_parts").values)
    assert set(moving["path_port"].values) == {"housing"}
    (split,) = cases.values()
    pressure = split.pressure[split.names.index(("moving_parts", "housing", "tx")), :, 1]
    velocity = results["velocity_order"].sel(dof="tx", order=1, option=REFERENCE_OPTION)
    vector = results["transfer_vector"].sel(dof="tx")
    hertz = results["order_frequency"].sel(order=1).item()
    ratio = np.abs(pressure / velocity.sum("source").item())
    between = vector.sel(frequency=slice(hertz - 25.0, hertz + 25.0))
    low, high = np.abs(between).min("frequency"), np.abs(between).max("frequency")
    assert ((ratio > low) & (ratio < high)).all()


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
def test_paths_of_every_rigid_machine_add_up(name, cases):
    def radiation(study, *_):
        return made_up_transfer_vectors(study, 0.01), False

    assert_adds_up(pipeline.run(shortened(name), radiation=radiation), cases)


@pytest.mark.long
@pytest.mark.parametrize(
    "name", ["copeland_sources", "copeland_inverter", "dagilis_sources", "estupinan_sources"]
)
def test_paths_through_frame_yoke_and_gas_add_up(name, cases):
    samples = {"uncertainty.random_samples": 4}
    results = run_made_up(shortened(name, **samples), gain=0.01)
    assert_adds_up(results, cases)
