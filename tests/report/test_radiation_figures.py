"""Figures and tables of the sound field alone, from closed forms, and the command that makes them.

The sources are small: dipoles for the translations, pairs of them for the rotations, over a floor.
"""

import numpy as np
import pytest
import xarray as xr
from radiation_parts import floor
from support import PIPELINES
from typer.testing import CliRunner

from vibroacoustics import pipeline
from vibroacoustics.base.vocabulary import (
    RIGID_BODY_DOFS,
    check,
    label_coordinates,
    stamp,
)
from vibroacoustics.commands import cli, outputs
from vibroacoustics.levels.sound_field import unit_sound_power
from vibroacoustics.radiation.arrangements import (
    directivity_angles,
    directivity_points,
    hemisphere_positions,
    map_points,
)
from vibroacoustics.radiation.exact import green, wavenumber
from vibroacoustics.report.charts.marks import Image
from vibroacoustics.report.figures.directivity import directivity
from vibroacoustics.report.figures.maps import (
    line_map,
    transfer_vectors,
    unit_level_db,
    unit_level_map,
)
from vibroacoustics.report.radiation_tables import analysis_of_radiation, radiation_figures
from vibroacoustics.results import storage
from vibroacoustics.study.sound_power import DirectivitySettings, MapSettings, SoundPowerSettings

FLOOR_Z_M = -0.225
FREQUENCY_HZ = np.array([50.0, 100.0, 500.0, 2000.0])
LINE_HZ = np.array([48.0, 58.0])
DOFS = list(RIGID_BODY_DOFS)
RECEIVERS = {"front_1m": (1.08, 0.0, 0.0), "left_1m": (-0.54, 0.94, 0.2)}


def fields(points, frequency):
    """Pressure per velocity (dof, frequency, dims of the points); rz is silent."""
    flat, half = points.reshape(-1, 3), 0.02

    def monopoles(place):
        return green(flat, place, frequency, [floor(FLOOR_Z_M)])

    strength = 1j * wavenumber(frequency)[:, None] * 412.0 * 0.035 / (2.0 * half)
    out = [strength * (monopoles(step) - monopoles(-step)) for step in half * np.eye(3)]
    for step in half * np.eye(3)[[1, 0]]:
        rise = np.array([0.0, 0.0, 0.1])
        upper = monopoles(step + rise) - monopoles(rise - step)
        lower = monopoles(step - rise) - monopoles(-rise - step)
        out.append(0.1 * strength * (upper - lower))
    out.append(np.zeros_like(out[0]))
    return np.array(out).reshape(6, len(frequency), *points.shape[:-1])


@pytest.fixture(scope="module")
def radiated() -> xr.Dataset:
    plane = map_points(MapSettings(spacing_m=0.1), FLOOR_Z_M)
    sphere = DirectivitySettings(step_rad=np.pi / 12.0)
    polar, azimuth = directivity_angles(sphere, on_floor=True)
    transfer = np.moveaxis(fields(np.array(list(RECEIVERS.values())), FREQUENCY_HZ), 2, 0)
    on_map = np.moveaxis(fields(plane, LINE_HZ), (0, 1), (2, 3))
    on_map[np.all(np.abs(plane[..., :2]) < 0.17, axis=-1) & (plane[..., 2] < 0.28)] = np.nan
    around = np.moveaxis(fields(directivity_points(sphere, FLOOR_Z_M), LINE_HZ), (0, 1), (2, 3))
    surface = hemisphere_positions(1.0) + np.array([0.0, 0.0, FLOOR_Z_M])
    on_surface = np.moveaxis(fields(surface, FREQUENCY_HZ), 2, 0)
    coords = {"receiver": list(RECEIVERS), "dof": DOFS, "frequency": FREQUENCY_HZ}
    lines = {"dof": DOFS, "line_frequency": LINE_HZ}
    angles = {"polar_angle": polar, "azimuth": azimuth}
    positions = {"position": np.arange(1, 11), "dof": DOFS, "frequency": FREQUENCY_HZ}
    on_surface = stamp("surface_transfer_vector", on_surface, positions)
    variables = {
        "transfer_vector": stamp("transfer_vector", transfer, coords),
        "transfer_vector_error": stamp("transfer_vector_error", 0.02 * np.abs(transfer), coords),
        "map_transfer_vector": stamp("map_transfer_vector", on_map, lines),
        "directivity_transfer_vector": stamp(
            "directivity_transfer_vector", around, {**lines, **angles}
        ),
        "surface_transfer_vector": on_surface,
        "unit_sound_power_level": unit_sound_power(
            on_surface, SoundPowerSettings(background_margin_db=10.0), 2.0 * np.pi
        ),
    }
    places = {
        f"map_{name}": (("map_row", "map_column"), plane[..., axis])
        for axis, name in enumerate("xyz")
    }
    return check(label_coordinates(xr.Dataset(variables, coords=places)))


def test_level_at_unit_velocity_is_of_root_mean_squares():
    # 1 Pa s/m at 1 mm/s rms is 1 mPa rms: 20 lg(1e-3/20e-6)
    assert unit_level_db(np.array(1.0 + 0.0j)) == pytest.approx(33.979400, abs=1e-6)
    assert np.isfinite(unit_level_db(np.array(0.0)))


def test_levels_at_microphones_with_their_error(radiated):
    chart = transfer_vectors(radiated)
    tx, *_, rz = chart.panels
    front = tx.marks[0]
    field = radiated["transfer_vector"].sel(receiver="front_1m", dof="tx").values
    np.testing.assert_allclose(front.y, unit_level_db(field))
    np.testing.assert_allclose(front.interval[1] - front.y, 20.0 * np.log10(1.02), atol=1e-9)
    assert [mark.words for mark in rz.marks] == ["no sound here"]
    assert (chart.columns, chart.wide) == (2, True)


def test_map_has_the_levels_of_each_motion(radiated):
    chart = unit_level_map(radiated)
    tz = chart.panels[2].marks[0]
    field = radiated["map_transfer_vector"].sel(dof="tz").isel(line_frequency=-1)
    np.testing.assert_array_equal(tz.values, unit_level_db(field.values))
    assert np.isnan(tz.values).any()
    assert tz.x.tolist() == radiated["map_x"].values[0].tolist()
    row = [panel.marks[0] for panel in chart.panels[:3]]
    top = max(np.nanmax(mark.values) for mark in row if isinstance(mark, Image))
    assert tz.scale[1] == top
    assert all(tz.scale[0] < level < top and level % 5.0 == 0.0 for level in tz.contours)


def test_polar_cuts_show_the_field_at_their_angles(radiated):
    chart = directivity(radiated)
    assert "Silent and left out: rz." in chart.caption
    field = radiated["directivity_transfer_vector"].sel(dof="ty").isel(line_frequency=-1)
    level = field.copy(data=unit_level_db(field.values))
    upright, flat = chart.panels[2:4]
    xz, yz = upright.marks
    for curve, shown, polar, azimuth in (
        (yz, 0.0, 0.5 * np.pi, 0.5 * np.pi),
        (yz, 120.0, np.pi / 6.0, 1.5 * np.pi),
        (xz, 60.0, np.pi / 6.0, 0.0),
        (flat.marks[0], 90.0, 0.5 * np.pi, 0.5 * np.pi),
    ):
        there = np.flatnonzero(np.isclose(curve.x, shown))[0]
        expected = level.sel(polar_angle=polar, azimuth=azimuth, method="nearest")
        assert curve.y[there] == pytest.approx(float(expected), abs=1e-9)


def test_only_the_figures_that_the_dataset_has_variables_for(radiated):
    drawn = radiation_figures(radiated)
    assert [picture.name for picture in drawn] == ["transfer_vectors", "map", "directivity"]
    assert all(picture.alt and picture.caption for picture in drawn)
    (alone,) = radiation_figures(radiated[["transfer_vector"]])
    assert alone.name == "transfer_vectors"


def test_line_map_of_a_run(radiated):
    field = radiated["map_transfer_vector"].sel(dof="tx").rename(line_frequency="speed")
    level = field.copy(data=unit_level_db(field.values)).expand_dims(option=["none"])
    chart = line_map(level.rename("map_level").to_dataset())
    assert [panel.title for panel in chart.panels] == ["48 rpm", "58 rpm"]
    np.testing.assert_array_equal(
        chart.panels[1].marks[0].values, level.sel(option="none").isel(speed=1).values
    )


def test_map_without_sound_is_drawn(radiated):
    silent = radiated.copy()
    silent["map_transfer_vector"] = 0.0 * radiated["map_transfer_vector"]
    panels = unit_level_map(silent).panels
    assert {mark.words for panel in panels for mark in panel.marks} == {"no sound here"}


def test_table_tells_levels_error_and_sound_power(radiated):
    text = analysis_of_radiation(radiated).text()
    assert text.isascii() or "µ" in text
    rows = [line.split() for line in text.splitlines()]
    level = unit_level_db(radiated["transfer_vector"].sel(receiver="front_1m", dof="tx").values)
    front = next(row for row in rows if row[:2] == ["front_1m", "tx"])
    # 250 and 1000 Hz are not tabulated; their neighbours are
    assert [float(cell) for cell in front[2:-1]] == pytest.approx(level, abs=0.051)
    assert float(front[-1]) == pytest.approx(20.0 * np.log10(1.02), abs=0.005)
    assert next(row for row in rows if row[:2] == ["front_1m", "rz"])[-1] == "-"
    assert "iso3744-hemisphere-10, S = 6.28 m²" in text
    assert "K1 + K2 = 0.5 dB more" in text
    power = radiated["unit_sound_power_level"].sel(dof="tx").values
    assert next(row for row in rows if row[:1] == ["tx"])[1] == f"{power[0]:.1f}"


@pytest.mark.long
def test_radiation_command(radiated, monkeypatch, tmp_path):
    monkeypatch.setattr(pipeline, "radiate", lambda study, progress: radiated)
    study = str(PIPELINES / "copeland_thesis.toml")
    outcome = CliRunner().invoke(cli.app, ["radiation", study, "--out", str(tmp_path / "out")])
    assert outcome.exit_code == 0, outcome.output
    assert f"results: {tmp_path / 'out' / 'transfer_vectors.nc'}" in outcome.output
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "transfer_vectors.nc",
        "transfer_vectors.html",
        "files.json",
        "transfer_vectors.svg",
        "map.svg",
        "directivity.svg",
    }
    read = storage.open_results(tmp_path / "out" / "transfer_vectors.nc")
    assert check(read).equals(radiated)


def test_nothing_is_written_when_a_figure_fails(radiated, tmp_path):
    broken = radiated.drop_vars("map_x")
    with pytest.raises(KeyError):
        outputs.write_analysis(
            analysis_of_radiation(broken), broken, tmp_path / "out", "radiated.nc"
        )
