"""A study's machine in its room, with vectors that are made up: levels, plate, samples, report."""

import numpy as np
import pytest
import xarray as xr
from pages import page_of
from rooms_made_up import HIGHEST_HZ, KITCHEN, RADIUS_M, made_up_vectors
from sound_studies import a_level
from sources_study import SOURCES_STUDY, made_up_modes
from support import TINY, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.base.decibel import energy_sum
from vibroacoustics.base.errors import SchemaError
from vibroacoustics.base.progress import no_progress
from vibroacoustics.levels import a_weighting
from vibroacoustics.pipeline.cost import run_cost
from vibroacoustics.radiation.rooms import of_study as rooms
from vibroacoustics.report.blocks import Part
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.in_room import (
    absorption,
    crossover_sentence,
    crossover_table,
    room_sentence,
    room_table,
    sones,
)
from vibroacoustics.results.size import result_bytes
from vibroacoustics.sound.files import full_scale_of
from vibroacoustics.sound.ingredients import ingredients
from vibroacoustics.sound.loudness import loudness_of
from vibroacoustics.stages import room as room_stage
from vibroacoustics.stages.room import vectors_of

RHO_C = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
PANEL = {
    "thickness_mm": 19.0,
    "density_kg_per_m3": 680.0,
    "youngs_modulus_gpa": 3.0,
    "loss_factor_ratio": 0.03,
    "length_mm": 600.0,
    "width_mm": 600.0,
}


def no_map(study, settings, air, progress):
    level = np.full((2, 3), 40.0)
    level[0, 0] = np.nan
    coords = {"room_map_y": [1.0, 2.0], "room_map_x": [1.0, 2.0, 3.0]}
    made = va.stamp("room_map_level", level, coords)
    made.attrs |= {"speed_rpm": 2900.0, "height_m": 1.2, "highest_band_hz": 800.0}
    return xr.Dataset({"room_map_level": made})


def run_in_room(study, patch, room=1.0, radiation=made_up_radiation, **changes):
    def vectors(study, settings, motions, progress):
        listeners, highest = settings.listeners, study.radiation.maximum_frequency_hz
        return made_up_vectors(listeners, motions, room, highest_hz=highest), False

    patch.setattr(room_stage, "vectors_of", vectors)
    patch.setattr(room_stage, "_map", no_map)
    return va.run(study.replace({"room": KITCHEN, **changes}), radiation=radiation)


@pytest.fixture(scope="module")
def kitchen():
    with pytest.MonkeyPatch.context() as patch:
        yield run_in_room(va.load_study(TINY), patch, structure_borne=PANEL)


def test_without_a_room_nothing_is_computed():
    results = va.run(va.load_study(TINY), radiation=made_up_radiation)
    assert not [name for name in results.data_vars if str(name).startswith("room_")]
    assert not SECTIONS["in-room"].applies(results)


def test_surfaces_have_their_absorption_in_results_and_report(kitchen):
    requested = kitchen["room_wall_absorption_requested"]
    waves = kitchen["room_wall_absorption"]
    difference = np.abs(waves - requested).where(kitchen["room_octave"] <= HIGHEST_HZ)
    assert difference.max() < 0.01
    (table,) = absorption(kitchen)
    surfaces = [name for row in table.rows for name in row[0].split(", ")]
    assert sorted(surfaces) == sorted(
        str(name).partition(".")[2] for name in kitchen["room_surface"].values
    )
    assert {cell.split(" → ")[1] for row in table.rows for cell in row[-2:]} == {"–"}


def test_a_surface_of_another_absorption_is_a_warning_before_waves(monkeypatch):
    monkeypatch.setattr(room_stage.storage, "cached", lambda *_: (xr.Dataset(), True))
    opening = {"absorption_ratio": [1.0] * 6}
    room = KITCHEN | {"walls": {"+x": opening}}
    study = va.load_study(TINY).replace({"room": room})
    with pytest.warns(UserWarning, match=r"room\.walls\.\+x: absorption of waves is 0\.94 instead"):
        vectors_of(study, study.room, (), no_progress)  # the stage has made-up vectors here


def test_what_a_run_would_refuse_is_refused_before():
    study, (x_mm, y_mm) = va.load_study(TINY), KITCHEN["foot_mm"]
    away_mm = 1e3 * study.machine.shell.cylinder.radius_m + 50.0  # the box is 100 mm off
    near = {"x_mm": x_mm - away_mm, "y_mm": y_mm, "height_mm": 300.0}
    room = KITCHEN | {"listeners": {"table": near}}
    with pytest.raises(va.ParameterError, match=r"room\.listeners\.table: stands within"):
        run_cost(study.replace({"room": room}))


def test_size_counts_the_lines_at_the_listeners(kitchen):
    study = va.load_study(TINY)
    rest = kitchen[["force_order"]]
    at_listeners = result_bytes(study.replace({"room": KITCHEN}), rest) - result_bytes(study, rest)
    assert at_listeners == kitchen["room_pressure_line"].nbytes > 0


def test_orders_by_waves_are_velocity_times_vectors(kitchen):
    """The first orders of the moving parts, all below the seam, in third octaves."""
    at = kitchen.sel(option="none").isel(speed=0)
    velocity = at["velocity_order"].sum(("source", "dof"))
    frequency = at["order_frequency"].values
    pressure = velocity.values * 0.01j * frequency
    band = at["room_band_level"].sel(listener="table")
    only_second = 0.5 * abs(pressure[2]) ** 2  # 96.7 Hz, alone in the third octave of 100 Hz
    rest = 10.0 ** (at["unmodelled_band_level"].sel(noise_band=100.0) / 10.0) * 4e-10
    by_hemisphere = 2.0 * np.pi * (1.0825**2 + 0.24**2) / RHO_C * rest
    gain = RHO_C / (2.0 * np.pi * RADIUS_M**2)  # as loud in the room as on the hemisphere
    expected = 10.0 * np.log10((only_second + by_hemisphere * gain) / 4e-10)
    assert band.sel(noise_band=100.0).item() == pytest.approx(expected.item(), abs=1e-3)


def test_what_no_source_explains_is_in_the_room(kitchen):
    """All of the published level: its power by the hemisphere, 9 dB above it, less 9.4 dB."""
    at = kitchen.sel(option="none").isel(speed=0)
    power = at["room_sound_power_level"].item()
    away = np.hypot(1.0825, 0.24)
    assert power == pytest.approx(56.0 + 10.0 * np.log10(2.0 * np.pi * away**2), abs=0.2)
    gains = energy_sum(at["room_band_level"].values + a_weighting(at["noise_band"].values), axis=-1)
    np.testing.assert_allclose(at["room_level"], gains, atol=0.05)  # lines off the bands' middles


def test_louder_waves_raise_the_place_and_what_is_above(kitchen):
    with pytest.MonkeyPatch.context() as patch:
        louder = run_in_room(va.load_study(TINY), patch, room=10.0)
    change = louder["room_level"] - kitchen["room_level"]
    np.testing.assert_allclose(change, 20.0, atol=1e-6)
    for name in ("room_place_gain", "room_place_gain_above"):
        np.testing.assert_allclose(louder[name] - kitchen[name], 20.0, atol=1e-9)


def test_the_seam_is_both_curves_and_their_difference(kitchen):
    assert list(kitchen["seam_band"].values) == [250.0, 315.0, 400.0, 500.0, 630.0, 800.0]
    difference = kitchen["room_gain_waves"] - kitchen["room_gain_diffuse"]
    np.testing.assert_allclose(kitchen["room_gain_difference"], difference, atol=1e-12)
    ratio = (10.0 ** (difference / 10.0)).mean("listener")
    np.testing.assert_allclose(kitchen["room_place_gain"], 10.0 * np.log10(ratio), atol=1e-9)
    assert np.all(np.abs(kitchen["room_place_gain"]) > 1.0)  # made up: alike in room and open


def test_gain_of_the_place_goes_with_frequency_and_holds_above():
    middle_hz = np.array([500.0, 630.0, 800.0, 1000.0])
    waves = np.array([[1.0, 2.0, 4.0, 8.0], [1.0, 2.0, 4.0, 8.0]])
    gains_db = rooms.position_gains_db(waves, np.ones((2, 4)))
    linear = 10.0 ** (gains_db / 10.0)
    np.testing.assert_allclose(linear, [1.0, 2.0, 4.0, 8.0, 3.75], rtol=1e-12)
    gain = rooms.gain_over_frequency(gains_db, middle_hz)
    np.testing.assert_allclose(gain(np.array([100.0, 800.0, 4000.0])), [1.0, 4.0, 3.75])


def test_waves_end_where_the_power_takes_over():
    share = rooms.wave_share(1000.0)
    np.testing.assert_allclose(share(np.array([399.0, 631.0])), [1.0, 0.0])
    lower = rooms.wave_share(315.0)
    np.testing.assert_allclose(lower(np.array([199.0, 315.0])), [1.0, 0.0], atol=1e-12)
    assert rooms.crossover_bands_hz(315.0) == (125.0, 315.0)


def test_plate_in_the_room(kitchen):
    """Mean power by waves of an amplitude of 1/m, above them direct and diffuse."""
    at = kitchen.sel(option="none").isel(speed=0)
    power = at["structure_borne_power"].values
    frequency = np.nan_to_num(at["tone_frequency"].values)
    weight = np.where(frequency > 0.0, 10.0 ** (a_weighting(np.maximum(frequency, 1)) / 10.0), 0.0)
    settings = va.load_study(TINY).replace({"room": KITCHEN}).room
    frequency = np.maximum(frequency, 20.0)
    share = rooms.wave_share(HIGHEST_HZ)(frequency)
    diffuse = rooms.diffuse_per_power(settings, rooms.foot_m(settings))(frequency)
    per_power = share * 2.0 * np.pi * RHO_C + (1.0 - share) * diffuse
    expected = 10.0 * np.log10(per_power @ (power * weight) / 4e-10)
    np.testing.assert_allclose(at["room_plate_level"], expected, atol=0.01)  # between lines
    both = energy_sum(np.stack([at["room_level"], at["room_plate_level"]]), axis=0)
    np.testing.assert_allclose(at["room_level_both_ways"], both, atol=1e-12)
    assert np.all(at["room_plate_level_low"] < at["room_plate_level_high"])


def test_a_plate_in_the_open_has_its_power_on_a_hemisphere():
    settings = va.load_study(TINY).replace({"room": KITCHEN}).room
    away_m, vectors = 2.3, made_up_vectors(settings.listeners)
    vectors["room_green_of_foot"] /= 2.0 * np.pi * away_m  # of a source on a hard floor
    got = rooms.plate_per_power(settings, vectors)(np.array([48.3, 96.7]))
    np.testing.assert_allclose(got, RHO_C / (2.0 * np.pi * away_m**2), rtol=2e-3)


@pytest.mark.parametrize("listener", ["table", "doorway"])
@pytest.mark.parametrize("option", ["none", "counterweight-half"])
def test_what_a_sound_is_made_of_has_the_level_in_the_room(kitchen, listener, option):
    """Both paths; without the lines of the plate by air alone."""
    speed = kitchen["speed"].item()
    at = kitchen.sel(option=option, listener=listener, speed=speed)
    both = energy_sum(np.stack([at["room_level"], at["room_plate_level"]]), axis=0)
    parts = ingredients(kitchen, option, listener, speed)
    assert a_level(parts) == pytest.approx(both.item(), abs=1e-9)
    by_air = ingredients(kitchen.drop_vars("room_plate_line_level"), option, listener, speed)
    assert a_level(by_air) == pytest.approx(at["room_level"].item(), abs=1e-9)
    np.testing.assert_allclose(
        np.angle(parts.lines.pressure_pa), np.angle(by_air.lines.pressure_pa), atol=1e-12
    )


def test_lines_below_the_seam_are_the_waves(kitchen):
    """Velocity times the made-up vector with its phase; `interpolation_weights` errs by 2e-4."""
    at = kitchen.sel(option="none").isel(speed=0)
    velocity = at["velocity_order"].sum(("source", "dof")).values
    frequency = at["order_frequency"].values
    assert frequency[4] < 400.0
    pressure = at["room_pressure_line"].sel(listener="doorway")
    by_waves = (velocity * 0.01j * frequency)[1:5]
    orders = pressure.sel(line=[f"order {number}" for number in range(1, 5)])
    np.testing.assert_allclose(orders, by_waves, rtol=4e-4)


def test_sounds_at_listeners_are_files_at_the_gain_of_all(kitchen, tmp_path):
    full_scale = full_scale_of(kitchen)
    (path,) = va.listen(kitchen, tmp_path, ["none"], ["table"], duration_s=1.0)
    assert path.name == f"none_table_{kitchen['speed'].item():g}rpm_{full_scale:g}Pa.wav"
    louder = kitchen.copy()
    louder["room_pressure_line"] = 1e3 * kitchen["room_pressure_line"]
    highest = np.abs(louder["room_pressure_line"]).sum("line").max().item()
    assert full_scale_of(louder) > highest > full_scale
    with pytest.raises(va.ParameterError, match=r"there are front_1m, .*table, doorway"):
        va.listen(kitchen, tmp_path, ["none"], ["behind"])
    without = kitchen.drop_vars(("room_pressure_line", "room_noise_band_level"))
    with pytest.raises(SchemaError, match="no sound in the room: run the study again"):
        ingredients(without, "none", "table", kitchen["speed"].item())


def test_loudness_at_a_listener_is_that_of_the_level_in_the_table(kitchen):
    speed = kitchen["speed"].item()
    table = room_table(kitchen, "table")
    column = table.head.index("Loudness, sone (diffuse field)")
    options = kitchen["option"].values.tolist()
    parts = [ingredients(kitchen, option, "table", speed) for option in options]
    loud = [one.loudness_sone for one in loudness_of(parts, field="diffuse")]
    assert [float(row[column]) for row in table.rows] == pytest.approx(loud, rel=5e-3)
    assert [float(text) for text in sones(kitchen, "table")] == pytest.approx(loud, abs=0.06)


def test_without_loudness_the_room_asks_for_a_run(kitchen):
    without = kitchen.drop_vars("loudness_in_room")
    assert len(room_table(without, "table").head) == 7
    *_, note = SECTIONS["in-room"].blocks(without)
    assert "no loudness" in note.words
    assert "Run the study again" in note.words


def test_report_says_how_loud_by_which_path_and_what_changes_it(kitchen):
    sentence = room_sentence(kitchen)
    assert sentence.startswith("In the room the machine without a balancer is ")
    assert "dB over the limit by night" in sentence
    assert "dominates" in sentence
    assert sentence.endswith(("dB or more.", " dB."))
    table = room_table(kitchen, "table")
    assert [row[0] for row in table.rows] == ["none", "counterweight-half"]
    assert len(table.head) == len(table.rows[0]) == 8
    assert "missed by" in table.rows[0][-1]
    assert "differ by more than 2 dB, in the mean over 2 listeners, at 250 Hz (" in (
        crossover_sentence(kitchen)
    )
    assert "mean, gain of the position" in {row[0] for row in crossover_table(kitchen).rows}
    section = SECTIONS["in-room"]
    assert section.applies(kitchen)
    page = page_of(Part("s", section.title, tuple(section.blocks(kitchen))))
    assert b"In the room" in page.html()


@pytest.mark.long
def test_samples_make_a_band_of_all_sources():
    study = va.load_study(SOURCES_STUDY)
    with pytest.MonkeyPatch.context() as patch:
        radiation = lambda study, *_: (made_up_modes(study), False)  # noqa: E731
        results = run_in_room(study, patch, radiation=radiation, **{"operation.stopping": False})
    low, high = (results[f"room_level_{end}_percent"] for end in (10, 90))
    assert np.all(high > low)
    assert set(results["room_source_level"]["sound_source"].values) >= {"gas", "keys", "motor"}
    assert study.radiation.maximum_frequency_hz > HIGHEST_HZ
    speed = results["speed"].values[0]
    there = results["room_level"].sel(option="none", speed=speed, listener="table").item()
    parts = ingredients(results, "none", "table", speed)
    # a third octave of even noise at 100 Hz, where A rises by 16 dB an octave
    assert a_level(parts) == pytest.approx(there, abs=0.3)
