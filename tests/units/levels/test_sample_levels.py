"""Levels of a sample with its discrepancies, beside sums by loops over lines and bins of noise."""

from types import SimpleNamespace

import numpy as np
import pytest

from vibroacoustics.base.vocabulary import VARIABLES, WEIGHTINGS
from vibroacoustics.base.weighting import WEIGHTING
from vibroacoustics.levels.axes import LevelAxes
from vibroacoustics.levels.by_source import GAIN_BANDS, sound_by_source
from vibroacoustics.levels.measured_points import BASELINE_BANDS, UNMODELLED_BANDS
from vibroacoustics.levels.sample_levels import (
    Deviating,
    sample_levels,
    with_discrepancy,
    with_gain,
)
from vibroacoustics.mechanics.loads import Lines
from vibroacoustics.mechanics.received_sound import NoisePower, ReceivedSound

SPEEDS, OPTIONS, SOURCES, RECEIVERS = [1500.0, 3000.0], ["none", "hood"], 3, ["front", "side"]
DISCREPANCIES, ORDERS = 2, 4
BIN_HZ = np.arange(80.0, 3000.0, 7.0)
HOOD = 0.1
"""Factor of the option on unmodelled noise, in all bands."""
SQUARE = (20e-6) ** 2
PUBLISHED_RPM = 3000.0
UNMODELLED = np.array([3e-5, 1e-4])
"""At the published speed, by discrepancy, Pa²."""


def spectrum(hertz):
    return np.where(hertz > 900.0, 1.0, 2.0) / np.sum(np.where(hertz > 900.0, 1.0, 2.0))


@pytest.fixture(scope="module")
def study():
    loss = SimpleNamespace(power_factor=lambda hertz: np.full(np.shape(hertz), HOOD))
    return SimpleNamespace(
        options={
            "none": SimpleNamespace(insertion_loss=lambda: None),
            "hood": SimpleNamespace(insertion_loss=lambda: loss),
        },
        catalogue_speed_rpm=PUBLISHED_RPM,
        baseline=None,
    )


@pytest.fixture(scope="module")
def axes():
    return LevelAxes(SPEEDS, OPTIONS, ["a", "b", "c"], RECEIVERS, GAIN_BANDS[3:-3])


@pytest.fixture(scope="module")
def sample(axes):
    """Orders 0 to 3, a line of the motor between them, and noise of two sources."""
    rng, received, gain = np.random.default_rng(0), {}, {}
    for speed in SPEEDS:
        first = speed / 60.0
        hertz = np.array([0.0, first, 2.0 * first, 3.0 * first, 101.3])
        names = ("order 0", "order 1", "order 2", "order 3", "motor: 2 x line")
        for option in OPTIONS:
            shape = (SOURCES, len(RECEIVERS), hertz.size)
            pressure = 1e-3 * (rng.normal(size=shape) + 1j * rng.normal(size=shape))
            noise = tuple(
                NoisePower(source, BIN_HZ, 1e-9 * rng.uniform(size=(len(RECEIVERS), BIN_HZ.size)))
                for source in (1, 2)
            )
            received[speed, option] = ReceivedSound(Lines(names, hertz, {}), pressure, noise)
            gain[speed, option] = 10.0 ** rng.normal(
                0.0, 0.5, (DISCREPANCIES, SOURCES, len(RECEIVERS), len(GAIN_BANDS))
            )
    sounds = [
        {
            key: sound_by_source(of_case, axes.bands).scaled(gain[key][k])
            for key, of_case in received.items()
        }
        for k in range(DISCREPANCIES)
    ]
    growth = SimpleNamespace(
        speed_factor=lambda rpm, published: (rpm / published) ** 3, spectrum=spectrum
    )
    middle_hz = np.array([band.middle_hz for band in UNMODELLED_BANDS])
    unmodelled = UNMODELLED[:, None] * spectrum(middle_hz)
    return Deviating(received, gain, sounds, SimpleNamespace(remainder=growth), unmodelled)


@pytest.fixture(scope="module")
def order_hz():
    return np.array(SPEEDS)[:, None] / 60.0 * np.arange(ORDERS)


@pytest.fixture(scope="module")
def levels(study, axes, sample, order_hz):
    return sample_levels(study, axes, order_hz, sample)


def decibel(square):
    return 10.0 * np.log10(square / SQUARE)


def weight(name, hertz):
    return 10.0 ** (float(WEIGHTING[name](np.array(hertz))) / 10.0)


def gain_of(gain, source, receiver, hertz):
    """Factor on the power of a source: that of the third octave, or of the nearest one."""
    distance = [abs(np.log(hertz / band.middle_hz)) for band in GAIN_BANDS]
    return gain[source, receiver, int(np.argmin(distance))]


def in_band(hertz, band):
    return band.lower_hz <= hertz < band.upper_hz


def lines_by_loops(of_case, gain, receiver):
    """Frequency and pressures by source of every line that sounds."""
    for line, hertz in enumerate(of_case.lines.frequency_hz.tolist()):
        if hertz > 0.0:
            yield (
                hertz,
                [
                    np.sqrt(gain_of(gain, source, receiver, hertz))
                    * of_case.pressure[source, receiver, line]
                    for source in range(SOURCES)
                ],
            )


def noise_by_loops(of_case, gain, receiver):
    """Source, frequency and power of every bin."""
    for part in of_case.noise:
        for hertz, power in zip(part.frequency_hz, part.power[receiver], strict=True):
            yield part.source, hertz, power * gain_of(gain, part.source, receiver, hertz)


def remaining(k, speed, option):
    """A-weighted, by band of unmodelled noise."""
    middle = np.array([band.middle_hz for band in UNMODELLED_BANDS])
    factor = HOOD if option == "hood" else 1.0
    return UNMODELLED[k] * (speed / PUBLISHED_RPM) ** 3 * factor * spectrum(middle)


def every_case():
    for k in range(DISCREPANCIES):
        for s, speed in enumerate(SPEEDS):
            for o, option in enumerate(OPTIONS):
                for r in range(len(RECEIVERS)):
                    yield (k, s, o, r), (speed, option)


def test_modelled_levels_by_all_weightings(levels, sample):
    for (k, s, o, r), key in every_case():
        of_case, gain = sample.received[key], sample.gain[key][k]
        for w, name in enumerate(WEIGHTINGS):
            square = sum(
                0.5 * abs(sum(parts)) ** 2 * weight(name, hertz)
                for hertz, parts in lines_by_loops(of_case, gain, r)
            )
            square += sum(
                p * weight(name, hertz) for _, hertz, p in noise_by_loops(of_case, gain, r)
            )
            assert levels["level_modelled"][k, s, o, r, w] == pytest.approx(decibel(square))


def test_third_octaves_of_noise_unmodelled_noise_and_all(levels, sample):
    middle = np.array([band.middle_hz for band in UNMODELLED_BANDS])
    for (k, s, o, r), (speed, option) in every_case():
        of_case, gain = sample.received[speed, option], sample.gain[speed, option][k]
        lines = list(lines_by_loops(of_case, gain, r))
        bins = list(noise_by_loops(of_case, gain, r))
        rest = dict(zip(middle, remaining(k, speed, option), strict=True))
        for b, band in enumerate(BASELINE_BANDS):
            tones = sum(0.5 * abs(sum(p)) ** 2 for hertz, p in lines if in_band(hertz, band))
            noise = sum(power for _, hertz, power in bins if in_band(hertz, band))
            left = rest.get(band.middle_hz, 0.0) / weight("A", band.middle_hz)
            for name, square in (
                ("noise_band_level", noise), ("total_band_level", tones + noise + left),
            ):  # fmt: skip
                found = SQUARE * 10.0 ** (levels[name][k, s, o, r, b] / 10.0)
                assert found == pytest.approx(square, rel=1e-9, abs=1e-30), (name, band)
            found = SQUARE * 10.0 ** (levels["unmodelled_band_level"][k, s, o, r, b] / 10.0)
            assert found == pytest.approx(left, rel=1e-9, abs=1e-30)


def test_orders_are_sums_of_phasors_with_gains(levels, sample):
    for (k, s, o, r), key in every_case():
        of_case, gain = sample.received[key], sample.gain[key][k]
        found = levels["order_level"][k, s, o, r]
        assert found.shape == (ORDERS, len(WEIGHTINGS))
        for order in range(1, ORDERS):
            hertz = key[0] / 60.0 * order
            (parts,) = [p for f, p in lines_by_loops(of_case, gain, r) if f == hertz]
            square = 0.5 * abs(sum(parts)) ** 2
            for w, name in enumerate(WEIGHTINGS):
                assert found[order, w] == pytest.approx(decibel(square * weight(name, hertz)))
        a = WEIGHTINGS.index("A")
        assert found[0, a] < -200.0  # a constant pressure is no sound


def test_sources_shares_and_totals(levels, sample):
    """A source has half the energy of its interference with each other one."""
    for (k, s, o, r), (speed, option) in every_case():
        of_case, gain = sample.received[speed, option], sample.gain[speed, option][k]
        alone, part = np.zeros(SOURCES), np.zeros(SOURCES)
        for hertz, pressure in lines_by_loops(of_case, gain, r):
            for source in range(SOURCES):
                a = weight("A", hertz)
                alone[source] += 0.5 * abs(pressure[source]) ** 2 * a
                part[source] += 0.5 * (pressure[source] * np.conj(sum(pressure))).real * a
        for source, hertz, power in noise_by_loops(of_case, gain, r):
            alone[source] += power * weight("A", hertz)
            part[source] += power * weight("A", hertz)
        rest = remaining(k, speed, option).sum()
        total = part.sum() + rest
        assert levels["level_total"][k, s, o, r] == pytest.approx(decibel(total))
        assert levels["source_level"][k, s, o, :, r] == pytest.approx(decibel(alone))
        assert levels["source_share"][k, s, o, :, r] == pytest.approx(part / total)
        assert levels["unmodelled_share"][k, s, o, r] == pytest.approx(rest / total)
        assert levels["residual_level"][k, s, o, r] == pytest.approx(decibel(rest))
    one = levels["source_share"].sum(axis=3) + levels["unmodelled_share"]
    np.testing.assert_allclose(one, 1.0, rtol=1e-12)
    assert (levels["source_share"] < 0.0).any()  # where lines cancel
    np.testing.assert_allclose(levels["level_unmodelled"], decibel(UNMODELLED))


def test_changes_are_against_none_in_the_same_discrepancy(levels):
    a, z = WEIGHTINGS.index("A"), WEIGHTINGS.index("Z")
    for name, of_level in (
        ("change_total", levels["level_total"]),
        ("change_modelled", levels["level_modelled"][..., a]),
        ("order_change", levels["order_level"][..., z]),
        ("change_1x", levels["order_level"][..., 1, z]),
    ):
        assert not levels[name][:, :, 0].any()
        np.testing.assert_allclose(levels[name][:, :, 1], of_level[:, :, 1] - of_level[:, :, 0])


def test_names_and_axes_are_those_of_the_vocabulary(levels, axes):
    sizes = {
        "speed": 2, "option": 2, "receiver": 2, "sound_source": SOURCES, "order": ORDERS,
        "weighting": 3, "band": len(axes.bands), "noise_band": len(BASELINE_BANDS),
    }  # fmt: skip
    for name, values in levels.items():
        assert values.shape == (DISCREPANCIES, *(sizes[dim] for dim in VARIABLES[name].dims)), name


def test_one_discrepancy_on_lines_and_noise_is_that_of_the_levels(levels, sample, axes):
    """What the representative sample sounds like."""
    key, k = (SPEEDS[1], "hood"), 1
    of_case = with_discrepancy(sample.received[key], sample.gain[key][k])
    np.testing.assert_array_equal(
        of_case.pressure, with_gain(sample.received[key], sample.gain[key])[k]
    )
    square = sound_by_source(of_case, axes.bands).total[0]
    a = WEIGHTINGS.index("A")
    np.testing.assert_allclose(decibel(square), levels["level_modelled"][k, 1, 1, :, a])


def test_with_a_baseline_there_is_no_total_by_third_octave(
    study, axes, sample, order_hz, monkeypatch
):
    """What was measured has its own bands; the total is the rest of the baseline and the model."""
    from vibroacoustics.levels import sample_levels as module

    points = {("front", SPEEDS[0]): None}
    residual = np.full((2, 2, 2), 2e-6)
    monkeypatch.setattr(module, "points_of", lambda *_: points)
    monkeypatch.setattr(module, "with_baseline", lambda *_: residual)
    measured = np.full((2, 2, 2, 1), np.nan)
    measured[0, :, 0] = 77.0
    monkeypatch.setattr(module, "baseline_orders", lambda *_: measured)
    with_orders = LevelAxes(
        axes.speeds, axes.options, axes.sources, axes.receivers, axes.bands, (2.0,)
    )
    found = module.sample_levels(study, with_orders, order_hz, sample)
    assert "total_band_level" not in found
    z = WEIGHTINGS.index("Z")
    np.testing.assert_array_equal(found["order_level"][:, 0, :, 0, 2, z], 77.0)
    assert not np.any(found["order_level"][:, 1, :, :, 2, z] == 77.0)
    np.testing.assert_allclose(found["residual_level"], decibel(2e-6))
