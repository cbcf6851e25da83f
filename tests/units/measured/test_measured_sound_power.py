"""ISO 3744 on recordings: a monopole of known power on a hard floor, with background and room."""

import numpy as np
import pytest
import xarray as xr
from synthetic_microphones import BANDS, recording

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.radiation.arrangements import box_positions, hemisphere_positions
from vibroacoustics.report.measured_power import analysis_of_sound_power, headline
from vibroacoustics.results.conditional import claim_of

POWER_DB = 60.0 + 8.0 * np.sin(np.arange(len(BANDS)))
MARGIN_DB = np.resize([6.5, 8.0, 10.0, 14.0, 25.0], len(BANDS))
RADIUS_M = 1.5
MIDDLE_HZ = np.array([band.middle_hz for band in BANDS])


@pytest.fixture(scope="module")
def positions() -> np.ndarray:
    given = hemisphere_positions(1.0)
    return RADIUS_M * given / np.linalg.norm(given, axis=1)[:, None]  # the table has two digits


@pytest.fixture(scope="module")
def quiet_db() -> np.ndarray:
    at_microphone = POWER_DB - 10.0 * np.log10(2.0 * np.pi * RADIUS_M**2)
    return at_microphone - 10.0 * np.log10(10.0 ** (MARGIN_DB / 10.0) - 1.0)


@pytest.fixture(scope="module")
def measured(positions: np.ndarray, quiet_db: np.ndarray) -> xr.Dataset:
    running = recording(positions, POWER_DB, quiet_db, with_source=True)
    still = recording(positions, POWER_DB, quiet_db, with_source=False)
    return va.sound_power([running], va.MeasurementSurface.hemisphere(RADIUS_M), [still], 1e6)


def test_power_of_a_monopole_behind_background_noise(measured: xr.Dataset) -> None:
    errors = measured["measured_power_level"].values - POWER_DB
    loud = MARGIN_DB <= 15.0
    assert np.abs(errors[loud]).max() < 0.02  # K1 is exact there
    assert np.abs(errors).max() < 0.3  # and left out above 15 dB
    assert measured["background_margin"].values == pytest.approx(MARGIN_DB, abs=0.02)


def test_a_weighted_power_is_the_sum_of_the_bands(measured: xr.Dataset) -> None:
    expected = 10.0 * np.log10(np.sum(10.0 ** ((POWER_DB + a_weighting(MIDDLE_HZ)) / 10.0)))
    assert measured["measured_power_level_a"].item() == pytest.approx(expected, abs=0.02)
    assert measured.attrs["grade"] == 2


def test_without_its_recording_the_background_counts_as_sound(
    positions: np.ndarray, quiet_db: np.ndarray
) -> None:
    running = recording(positions, POWER_DB, quiet_db, with_source=True)
    measured = va.sound_power([running], va.MeasurementSurface.hemisphere(RADIUS_M))
    errors = measured["measured_power_level"].values - POWER_DB
    k1 = -10.0 * np.log10(1.0 - 10.0 ** (-MARGIN_DB / 10.0))
    assert errors == pytest.approx(k1, abs=0.02)
    assert np.isnan(measured["background_margin"].values).all()
    assert measured.attrs["grade"] == 0
    assert measured.attrs["missing_for_grade"] == "background, K2"


def test_loud_background_makes_an_upper_bound(positions: np.ndarray) -> None:
    at_microphone = POWER_DB - 10.0 * np.log10(2.0 * np.pi * RADIUS_M**2)
    running = recording(positions, POWER_DB, at_microphone, with_source=True)
    still = recording(positions, POWER_DB, at_microphone, with_source=False)
    measured = va.sound_power([running], va.MeasurementSurface.hemisphere(RADIUS_M), [still])
    assert measured.attrs["grade"] == 0
    assert measured.attrs["missing_for_grade"] == "K2"
    surface = va.MeasurementSurface.hemisphere(RADIUS_M)
    measured = va.sound_power([running], surface, [still], 1e6)
    assert measured["background_margin"].values == pytest.approx(3.01, abs=0.02)
    assert measured["background_correction"].values == pytest.approx(1.26, abs=0.01)
    assert (measured["measured_power_level"].values > POWER_DB).all()
    assert measured.attrs["grade"] == 3


def test_reflections_of_the_room_are_taken_off(positions: np.ndarray) -> None:
    """The reverberant field 4 W rho c/A adds to the direct one: K2 takes it off exactly."""
    volume, seconds = 130.0, np.linspace(1.2, 0.4, len(BANDS))
    area = va.levels.reverberant_absorption_area_m2(volume, seconds)
    assert area == pytest.approx(0.16 * volume / seconds)
    reverberant = POWER_DB + 10.0 * np.log10(4.0 / area)
    running = recording(positions, POWER_DB, reverberant, with_source=True)
    given = {band.nominal_hz: one for band, one in zip(BANDS, area, strict=True)}
    surface = va.MeasurementSurface.hemisphere(RADIUS_M)
    measured = va.sound_power([running], surface, absorption_area_m2=given)
    assert measured["measured_power_level"].values == pytest.approx(POWER_DB, abs=0.02)
    k2 = measured["environment_correction"].values
    assert k2 == pytest.approx(10.0 * np.log10(1.0 + 4.0 * surface.area_m2 / area))
    assert measured.attrs["missing_for_grade"] == "background"
    silence = recording(positions, POWER_DB, POWER_DB - 60.0, with_source=False)
    measured = va.sound_power([running], surface, [silence], given)
    assert measured.attrs["missing_for_grade"] == ""
    assert measured.attrs["grade"] == 3  # K2A lies between 4 and 7 dB


def test_box_is_its_surface_times_the_mean_over_its_positions() -> None:
    """A small source on a box: the method itself reads too high, by what its surface says."""
    at = box_positions(0.1, 0.1, 0.1, 1.0)
    measured = va.sound_power(
        [recording(at, POWER_DB, None, with_source=True)],
        va.MeasurementSurface.box(0.1, 0.1, 0.1, 1.0),
    )
    mean = np.mean(1.0 / np.sum(at**2, axis=1)) / (2.0 * np.pi)
    area = 2.1 * 2.1 + 4.0 * 2.1 * 1.1
    expected = POWER_DB + 10.0 * np.log10(area * mean)
    assert measured["measured_power_level"].values == pytest.approx(expected, abs=0.02)
    assert measured["channel"].size == 9


def test_bands_beyond_the_sample_rate_are_empty(positions: np.ndarray) -> None:
    running = recording(positions, POWER_DB, None, with_source=True)
    slow = va.label_recording(
        running["signal"].values[:, ::4], 6400.0, list(running["channel"].values), ["Pa"] * 10
    )
    measured = va.sound_power([slow], va.MeasurementSurface.hemisphere(RADIUS_M))
    level = measured["measured_power_level"]
    assert np.isnan(level.sel(band=slice(3000.0, None))).all()
    assert np.isfinite(level.sel(band=slice(None, 2500.0))).all()


def test_channels_that_are_no_sound_are_left_out_and_none_is_refused() -> None:
    ones = va.label_recording(np.ones((1, 100)), 25600.0, ["foot"], ["m/s²"])
    with pytest.raises(ParameterError, match="no channel is sound pressure"):
        va.sound_power([ones], va.MeasurementSurface.hemisphere(1.0))


def test_room_must_be_told_at_every_band(positions: np.ndarray) -> None:
    running = recording(positions[:1], POWER_DB, None, with_source=True)
    surface = va.MeasurementSurface.hemisphere(1.0)
    with pytest.raises(ParameterError, match="no value at 125 Hz"):
        va.sound_power([running], surface, absorption_area_m2={100.0: 50.0})
    with pytest.raises(ParameterError, match="absorption_area_m2 = -1 m² at 100 Hz"):
        va.sound_power([running], surface, absorption_area_m2=-1.0)


def test_sizes_out_of_range() -> None:
    with pytest.raises(ParameterError, match=r"radius_m = 99 m: must be 0.5 to 16 m"):
        va.MeasurementSurface.hemisphere(99.0)
    with pytest.raises(ParameterError, match=r"height_m = 0 m: must be 0.01 to 20 m"):
        va.MeasurementSurface.box(1.0, 1.0, 0.0, 1.0)


@pytest.mark.parametrize(
    ("condition", "missing"),
    [
        ("six microphones", "10 or 20 microphones"),
        ("background elsewhere", "background at each microphone"),
        ("dead microphone", "sound at "),
        ("sample rate", "bands to 10 kHz"),
    ],
)
def test_a_grade_falls_with_each_condition(
    positions: np.ndarray, quiet_db: np.ndarray, condition: str, missing: str
) -> None:
    running = recording(positions, POWER_DB, quiet_db, with_source=True)
    still = recording(positions, POWER_DB, quiet_db, with_source=False)
    if condition == "six microphones":
        running, still = (each.isel(channel=slice(6)) for each in (running, still))
    if condition == "background elsewhere":
        still = still.isel(channel=slice(4))
    if condition == "dead microphone":
        gain = xr.where(running["channel"] == running["channel"][3], 0.01, 1.0)
        running = running.assign(signal=running["signal"] * gain)
        missing += str(running["channel"][3].item())
    if condition == "sample rate":
        running, still = (each.assign_attrs(sample_rate_hz=16_000.0) for each in (running, still))
    measured = va.sound_power([running], va.MeasurementSurface.hemisphere(RADIUS_M), [still], 1e6)
    assert measured.attrs["grade"] == 0
    assert measured.attrs["missing_for_grade"] == missing
    words = f"no grade without {missing}"
    assert headline(measured).endswith(f"{words}.")
    analysis = analysis_of_sound_power(measured)
    assert analysis.files()["sound_power.csv"].decode().splitlines()[-1].endswith(f",{words}")
    assert analysis.json()["tables"]["sound_power"]["grade"][-1] == words
    assert f"L_WA = {claim_of(measured, 'sound power level').short}" in analysis.text()
