"""What a measured spectrum settled, of shares and third octaves by hand."""

import pytest
import xarray as xr
from test_report_sources import with_parameters, with_sources

from vibroacoustics.base.vocabulary import stamped
from vibroacoustics.report.blocks import Text
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.measured_spectrum import (
    band_table,
    differing_sentence,
    settled_sentence,
    settled_table,
)
from vibroacoustics.report.sections.sources.words import samples_sentence, source_share
from vibroacoustics.report.sections.unknowns import most_valuable

SETTINGS = {"microphone": "front_1m", "speed_rpm": 2900.0, "deviation_db": 2.0}
BANDS_HZ, MEASURED = [400.0, 500.0, 630.0], [40.0, 41.0, 42.0]
AFTER = [[38.0, 45.2, 41.0], [40.5, 45.5, 46.0], [43.0, 46.0, 48.0]]
"""Off by 0.5, 4.5 and 4.0 dB, with a limit of 4 dB."""


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    """The keys' share is half as wide as with the level alone, that of the gas as wide."""
    results = with_sources({"none": 40.0, "idle": 40.0})
    sources = list(map(str, results["sound_source"].values))
    ends = {"low": [], "mean": [], "high": []}
    for name in [*sources, "unmodelled"]:
        band = (0.0, 0.005, 0.005)
        if name in ("keys", "gas"):
            here = source_share(results, name, 2900.0)
            width = (2.0 if name == "keys" else 1.0) * (here.highest - here.lowest)
            band = (0.1, 0.3, 0.1 + width)
        for end, value in zip(ends, band, strict=True):
            ends[end].append(value)
    names = ("_10_percent", "", "_90_percent")
    labelled = {
        f"alternative_share{name}": [of_end]
        for name, of_end in zip(names, ends.values(), strict=True)
    }
    labelled |= {f"alternative_level{name}": [50.0] for name in names}
    labelled |= {
        "alternative_effective": [50.0],
        "spectrum_measured": MEASURED,
        "spectrum_before": AFTER,
        "spectrum_after": AFTER,
    }
    coords = {
        "alternative": ["level alone"], "energy_part": [*sources, "unmodelled"],
        "spectrum_band": BANDS_HZ, "datum_quantile": [0.1, 0.5, 0.9],
    }  # fmt: skip
    merged = results.merge(stamped(labelled, coords)).assign_attrs(results.attrs)
    return with_parameters(merged, evidence={"spectrum": SETTINGS})


def test_ratios_are_those_of_the_widths(results: xr.Dataset) -> None:
    rows = {row[0]: row for row in settled_table(results).rows}
    assert rows["Oldham keys"][-1] == "0.50"
    assert rows["Gas forces"][-1] == "1.0"
    assert rows["Oldham keys"][2] == source_share(results, "keys", 2900.0).in_percent()
    assert "share of Oldham keys best" in settled_sentence(results)
    assert "is 0.50 times as wide" in settled_sentence(results)


def test_third_octaves_that_the_model_misses_are_named(results: xr.Dataset) -> None:
    assert differing_sentence(results).endswith(
        "by more than 4 dB from the measured third octave 500 Hz."
    )
    assert [row[-1] for row in band_table(results).rows] == ["agrees", "differs", "agrees"]
    assert [row[:2] for row in band_table(results).rows][1] == ("500", "41.0")
    wider = with_parameters(results, evidence={"spectrum": {**SETTINGS, "deviation_db": 3.0}})
    assert (
        differing_sentence(wider)
        == "The weighted model agrees with every third octave within 6 dB."
    )


def test_the_section_needs_samples_and_a_spectrum(results: xr.Dataset) -> None:
    section = SECTIONS["measured-spectrum"]
    assert section.applies(results)
    assert not section.applies(results.drop_vars("spectrum_after"))
    words = " ".join(block.words for block in section.blocks(results) if isinstance(block, Text))
    assert "Sums over octaves weigh, with a standard deviation of 2 dB" in words


def test_words_of_the_report_know_the_spectrum(results: xr.Dataset) -> None:
    """It is named among the data, and no longer advised as a measurement."""
    without = results.drop_vars("spectrum_measured")
    assert "of the published level and of the measured spectrum" in samples_sentence(results)
    assert "spectrum" not in samples_sentence(without)
    assert most_valuable(results) is None
    assert most_valuable(without) == ("dominant source", "a third-octave spectrum")
