"""Which channels are dead or impossible, and which only look like it."""

import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy.io import wavfile
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.arrays import Array
from vibroacoustics.recordings import blocks
from vibroacoustics.recordings.extent import PIECE, extent
from vibroacoustics.recordings.quantities import QUANTITIES, quantity
from vibroacoustics.recordings.suspects import sensor_limits, suspect_channels

NOISE = np.random.default_rng(8).standard_normal(4000)
SHIPPED = sorted((ROOT / "data" / "recordings").glob("*.[lu]*"))


def found(*channels: tuple[Array, str]) -> list[tuple[str, str]]:
    """Name and kind of the suspects among channels `0`, `1`, …, samples and unit each."""
    factors = [quantity(unit).factor for _, unit in channels]
    named = suspect_channels(
        list(map(str, range(len(channels)))),
        [unit for _, unit in channels],
        factors,
        [extent(samples) for samples, _ in channels],
    )
    return [(each.channel, each.kind) for each in named]


@pytest.mark.parametrize("file", SHIPPED, ids=[file.name for file in SHIPPED])
def test_shipped_recordings_give_no_warning(file: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        va.read_recording(file)


def test_living_channels() -> None:
    """Quiet ones beside loud ones, pulses, a constant speed, a slow pressure."""
    quiet_pa = 2e-4 * NOISE  # 20 dB
    loud_pa = 6.3 * NOISE  # 110 dB
    pulses = np.where(np.arange(4000) % 40 < 2, 1.0, 0.0)
    assert found((quiet_pa, "Pa"), (loud_pa, "Pa"), (loud_pa, "Pa")) == []
    assert found((pulses, "1"), (5.0 * pulses, "V"), (1e-4 * NOISE, "V")) == []
    assert found((np.full(4000, 2900.0), "rpm"), (np.full(4000, 0.0), "1")) == []
    assert found((300.0 + 1e-3 * NOISE, "bar"), (np.linspace(0.0, 5e3, 4000), "rad")) == []
    assert found((np.zeros(9), "Pa")) == []


def test_suspects() -> None:
    assert found((np.full(4000, 0.3), "Pa"), (NOISE, "Pa")) == [("0", "dead")]
    assert found((np.zeros(4000), "V")) == [("0", "dead")]
    assert found((1e-5 * NOISE, "m/s²"), (NOISE, "m/s²")) == [("0", "dead")]
    assert found((1e-5 * NOISE, "m/s²"), (NOISE, "Pa")) == []
    # beside an impossible channel a quiet one is no dead one
    assert found((1e-3 * NOISE, "Pa"), (1e30 * NOISE, "Pa")) == [("1", "beyond")]
    assert found((1e6 + NOISE, "Pa"), (1e4 + NOISE, "kPa"), (2e9 * NOISE, "mm/s²")) == [
        ("0", "beyond"), ("2", "beyond"),
    ]  # fmt: skip


def test_squares_beyond_the_largest_number_do_no_harm() -> None:
    assert found((1e200 * NOISE, "Pa"), (NOISE, "Pa")) == [("0", "beyond")]


@pytest.mark.parametrize(("bits", "kind"), [(16, np.int16), (24, np.int32), (32, np.int32)])
def test_last_bit_of_a_wav_file(tmp_path: Path, bits: int, kind: type) -> None:
    """Noise of one step either side is dead, noise of ten steps is alive; so is a tacho of 0, 1."""
    steps = np.stack([np.sign(np.round(NOISE)), np.round(3.0 * NOISE), NOISE > 0.0])
    shift = 2**8 if bits == 24 else 1  # as the upper bits of 32: 24 bits in a wider format
    wavfile.write(tmp_path / "a.wav", 1000, (shift * steps).astype(kind).T)
    units = {"channel 1": "Pa", "channel 2": "Pa", "channel 3": "V"}
    if bits == 32:  # further bits of a recorder of 24 are no signal either
        units["channel 2"] = "1"
    with pytest.warns(va.RecordingWarning, match="the last bit, alone") as warned:
        va.read_recording(tmp_path / "a.wav", units=units, calibration={"*": 20.0})
    assert len(warned) == 1
    assert "channel 'channel 1'" in str(warned[0].message)


def test_extent_in_pieces() -> None:
    samples = 3.0 + np.random.default_rng(1).standard_normal(2 * PIECE + 17)
    whole = extent(samples, (-32768.0, 32767.0))
    assert whole.samples == samples.size
    assert (whole.lowest, whole.highest) == (samples.min(), samples.max())
    # the rounding of sums in other orders: far below 1e-12 of the value
    assert whole.mean == pytest.approx(samples.mean(), rel=1e-12)
    assert whole.deviation == pytest.approx(samples.std(), rel=1e-12)
    assert whole.step == 1.0


def test_a_recording_in_blocks_is_judged_behind_its_last_block(tmp_path: Path) -> None:
    """The channel is silent in the first half only: it is alive; the other one never speaks."""
    late = np.concatenate([np.zeros(2000), NOISE[:2000]])
    labelled = va.label_recording([late, np.zeros(4000)], 1000.0, ["late", "dead"], ["Pa", "Pa"])
    opened = va.open_recording(va.export_recording(labelled, tmp_path / "a.nc"))
    opened.read(["late", "dead"], 0, 2000)
    with pytest.warns(va.RecordingWarning, match="'dead': is dead: all 4000 samples") as warned:
        opened.read(["late", "dead"], 2000, 4000)
    assert len(warned) == 1
    assert "is dead" in opened.attributes["reading_remarks"]
    opened.read(["late", "dead"], 2000, 4000)  # again, without a warning
    held = pytest.warns(va.RecordingWarning, match="'dead'")
    with held:
        assert len(blocks.hold_recording(tmp_path / "a.nc").suspects) == 1


def test_every_unit_has_a_limit_or_none_by_intent() -> None:
    limits = sensor_limits()
    without = {unit for unit in QUANTITIES if unit not in limits}
    without -= {unit for unit in QUANTITIES if QUANTITIES[unit].unit in ("rad", "1")}
    plain = {row_unit for row in limits.values() for row_unit in row["units"]}
    assert without <= plain
    for row in limits.values():
        low, high = row["range"]
        assert low < row["highest"] < high, row["quantity"]
        assert {quantity(unit).unit for unit in row["units"]} == {row["unit"]}
        assert row["source"].startswith("assumed: ")


def test_components_of_forces_may_be_zero(tmp_path: Path) -> None:
    """A machine by recorded forces: a direction without force is no dead sensor."""
    from vibroacoustics.mechanisms.tabulated.other_files import read_recorded

    force = np.cos(2.0 * np.pi * np.arange(100) / 100.0)
    labelled = va.label_recording([force, 0.0 * force], 5000.0, ["a fx", "a fz"], ["N", "N"])
    file = va.export_recording(labelled, tmp_path / "forces.nc")
    assert read_recorded(file, 3000.0).sources == ("a",)
