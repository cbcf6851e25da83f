"""Shares of the energy in words: those of all samples at the published level, once."""

import json

import pytest
import xarray as xr

from vibroacoustics.report.energy_words import energy_table, spectrum_sentence
from vibroacoustics.report.source_words import _carries, _modelled_and_rest, source_share

SHARES = {  # quantiles of gas, keys and unmodelled noise
    "all data": [[0.02, 0.2, 0.7], [0.002, 0.3, 0.8], [0.1, 0.4, 0.9]],
    "level alone": [[0.1, 0.7, 0.9], [0.01, 0.2, 0.6], [0.0, 0.1, 0.5]],
}


@pytest.fixture
def results() -> xr.Dataset:
    parts = ["gas", "keys", "unmodelled"]
    return xr.Dataset(
        {
            "energy_share": (("evidence", "energy_part", "datum_quantile"), [*SHARES.values()]),
            "energy_majority": (("evidence", "energy_part"), [[0.16, 0.3, 0.4], [0.6, 0.1, 0.1]]),
            "evidence_effective": ("evidence", [100.0, 200.0]),
        },
        {"evidence": [*SHARES], "energy_part": parts, "datum_quantile": [0.1, 0.5, 0.9]},
        {"words": json.dumps({"sources": {"gas": "gas forces", "keys": "Oldham keys"}})},
    )


def test_sentences_have_the_numbers_of_the_table(results: xr.Dataset) -> None:
    assert source_share(results, "gas")[:3] == (0.02, 0.2, 0.7)
    assert _carries(results, "keys", 0) == pytest.approx(0.3)
    modelled, rest = _modelled_and_rest(results, 0)
    assert modelled[:3] == pytest.approx((0.1, 0.6, 0.9))
    assert rest[:3] == (0.1, 0.4, 0.9)
    table = energy_table(results)
    assert table is not None
    assert table.rows[1][1] == "30\u00a0% (<1\u00a0% to 80\u00a0%)"


def test_the_sentence_is_about_the_source_that_the_spectrum_changes_most(
    results: xr.Dataset,
) -> None:
    sentence = spectrum_sentence(results)
    assert sentence.startswith("With the published spectral share gas forces make 20\u00a0%")
    assert spectrum_sentence(results.isel(evidence=[0])) == ""
