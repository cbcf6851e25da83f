"""A recording of known orders and noise, analysed, is the baseline that an option changes."""

import numpy as np
import pytest
from support import ROOT, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.levels.bands import bands_between
from vibroacoustics.results.storage import write_results

RATE_HZ = 2048.0
TACHO_DEG = 40.0
ORDERS = np.arange(1, 11)
BANDS = bands_between(3, 25.0, 500.0)
NOISE_DB = 40.0 + 4.0 * np.cos(np.arange(len(BANDS)))
BESIDE = (*bands_between(3, 16.0, 20.0), *BANDS, *bands_between(3, 630.0, 800.0))
BESIDE_DB = np.concatenate([[43.0, 43.0], NOISE_DB, [43.0, 43.0]])
"""Noise goes on beside the bands: blocks of 2 s do not tell a steep edge of it."""
AT = {"receiver": "front_1m"}
OPTION = "counterweight-full"


@pytest.fixture(scope="module")
def study():
    asked = {
        "operation.speed_rpm": [900.0, 930.0, 1100.0],
        "operation.maximum_order": 10,
        "options.softer-mounts": None,
        "options.lanchester": None,
    }
    return va.load_study(ROOT / "pipelines" / "reciprocating_table.toml").replace(asked)


@pytest.fixture(scope="module")
def model(study):
    return va.run(study, radiation=made_up_radiation)


def noise(samples, generator, lines_hz):
    """Lines of even energy in each band, random in phase: the energy of a band is known.

    Where they are far apart it is so at any time.
    """
    frequency = np.fft.rfftfreq(samples, 1.0 / RATE_HZ)
    apart = round(lines_hz * samples / RATE_HZ)
    spectrum = np.zeros(frequency.size, dtype=complex)
    for band, level in zip(BESIDE, BESIDE_DB, strict=True):
        lines = np.arange(frequency.size) % apart == round(0.35 * apart)  # no order there
        lines &= (frequency >= band.lower_hz) & (frequency < band.upper_hz)
        square = 4e-10 * 10.0 ** (level / 10.0) / lines.sum()
        phase = np.exp(2j * np.pi * generator.uniform(size=lines.sum()))
        spectrum[lines] = np.sqrt(2.0 * square) * phase
    return np.fft.irfft(spectrum, samples) * samples / 2.0


class Machine:
    """Tones whose levels and phases are straight lines over speed."""

    def __init__(self, generator):
        self.level, self.growth = generator.uniform(70, 77, 10), generator.uniform(-0.02, 0.02, 10)
        self.phase, self.turn = generator.uniform(-3, 3, 10), generator.uniform(-3e-3, 3e-3, 10)

    def peaks(self, rpm):
        """Complex peaks at the crank angle of the study, shape (order, ...)."""
        off = np.asarray(rpm)[None] - 1000.0
        level = self.level[:, None] + self.growth[:, None] * off
        phase = self.phase[:, None] + self.turn[:, None] * off
        return np.sqrt(2.0) * 2e-5 * 10.0 ** (level / 20.0) * np.exp(1j * phase)


def recorded(machine, first_rpm, last_rpm, duration_s, generator, lines_hz):
    samples = int(duration_s * RATE_HZ)
    time = np.arange(samples) / RATE_HZ
    rpm = first_rpm + (last_rpm - first_rpm) * time / duration_s
    turned = first_rpm * time + (last_rpm - first_rpm) * time**2 / (2.0 * duration_s)
    angle = 0.3 + 2.0 * np.pi * turned / 60.0
    sound = noise(samples, generator, lines_hz)
    for order, peak in zip(ORDERS, machine.peaks(rpm), strict=True):
        sound += (peak * np.exp(1j * order * angle)).real
    past = (angle - np.radians(TACHO_DEG) + np.pi) % (2.0 * np.pi) - np.pi
    tacho = np.clip(0.5 + past / 0.6, 0.0, 1.0)
    return va.label_recording([sound, tacho], RATE_HZ, ["front_1m", "tacho"], ["Pa", "V"])


def analysed(recording, **more):
    settings = va.OrderAnalysis(
        va.SpeedChannel("tacho"),
        tuple(map(float, ORDERS)),
        maximum_order=46.0,
        resolution_order=0.05,
        **more,
    )
    return va.analyse_orders(recording, settings)


def truth(machine, model, option, rpm):
    """Levels of orders and of bands that the machine has with an option."""
    lines = model["pressure_line"].sel(speed=rpm, **AT).sum("sound_source")
    modelled = lines.isel(line=slice(1, 11)).transpose("option", "line")
    change = modelled.sel(option=option).values - modelled.sel(option="none").values
    square = 0.5 * np.abs(machine.peaks(rpm)[:, 0] + change) ** 2 / 4e-10
    hertz = ORDERS * rpm / 60.0
    within = [(hertz >= band.lower_hz) & (hertz < band.upper_hz) for band in BANDS]
    bands = 10.0 ** (NOISE_DB / 10.0) + [square[one].sum() for one in within]
    return 10.0 * np.log10(square), 10.0 * np.log10(bands)


def obtained(results, option, rpm):
    here = results.sel(option=option, speed=rpm, **AT)
    bands = here["baseline_band_level"].sel(baseline_band=[band.nominal_hz for band in BANDS])
    return here["baseline_order_level"].values, bands.values


@pytest.mark.long
def test_steady_recording_changed_is_the_truth(tmp_path, study, model):
    generator = np.random.default_rng(1)
    machine = Machine(generator)
    orders = analysed(recorded(machine, 930.0, 930.0, 120.0, generator, 0.05))
    write_results(orders, tmp_path / "orders.nc")
    baseline = {"file": str(tmp_path / "orders.nc"), "tacho_angle_deg": TACHO_DEG}
    quiet = {"machine.overall_noise.level_dba": 0.0}  # no remainder above the recording's bands
    at_930 = study.replace({"operation.speed_rpm": [930.0], "measured.baseline": baseline} | quiet)
    results = va.run(at_930, radiation=made_up_radiation)
    for option in ("none", OPTION):
        of_orders, of_bands = truth(machine, model, option, 930.0)
        found_orders, found_bands = obtained(results, option, 930.0)
        assert np.abs(found_orders - of_orders).max() < 0.05
        assert np.abs(found_bands - of_bands).max() < 0.1
    assert results["baseline_order_phase"].sel(AT).values.min() == 1.0
    known = results["baseline_band_level"].sel(option="none", **AT).dropna("baseline_band")
    assert known["baseline_band"].values[-1] == 800.0  # by the recording's own third octaves
    total = results["level_total"].sel(option="none", **AT).item()
    middle_hz = np.array([band.middle_hz for band in BESIDE])
    of_orders = truth(machine, model, "none", 930.0)[0]
    levels = np.concatenate([BESIDE_DB, of_orders])
    weights = a_weighting(np.concatenate([middle_hz, ORDERS * 930.0 / 60.0]))
    weighted = 10.0 * np.log10(np.sum(10.0 ** ((levels + weights) / 10.0)))
    assert total == pytest.approx(weighted, abs=0.02)


@pytest.mark.long
def test_run_up_changed_is_the_truth(tmp_path, study, model):
    """At a speed that was measured, between two, and with the noise that 8 s of it have."""
    generator = np.random.default_rng(2)
    machine = Machine(generator)
    recording = recorded(machine, 810.0, 1190.0, 160.0, generator, 2.0)
    orders = analysed(recording, speed_step_rpm=20.0, with_map=True)
    write_results(orders, tmp_path / "orders.nc")
    baseline = {"file": str(tmp_path / "orders.nc"), "tacho_angle_deg": TACHO_DEG}
    results = va.run(study.replace({"measured.baseline": baseline}), radiation=made_up_radiation)
    width = np.array([band.upper_hz - band.lower_hz for band in BANDS])
    scatter_db = 10.0 / np.log(10.0) / np.sqrt(width * 160.0 / 19.0)  # of noise over a time
    for rpm in study.operation.speed_rpm:
        for option in ("none", OPTION):
            of_orders, of_bands = truth(machine, model, option, rpm)
            found_orders, found_bands = obtained(results, option, rpm)
            assert np.abs(found_orders - of_orders).max() < 0.05
            tonal = of_bands > NOISE_DB + 10.0
            off = np.abs(found_bands - of_bands)
            assert np.all(off < np.where(tonal | (scatter_db < 0.15), 0.1, 2.0 * scatter_db))
