"""How far the published spectral share changes shares, in words."""

import pytest
import xarray as xr
from test_report_sources import with_sources

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.sections.sources.content import spectrum_sentence

PARTS = ["gas", "keys", "motor", "moving_parts", "unmodelled"]
SHARE = {
    "level alone": [0.70, 0.20, 0.0, 0.0, 0.10],
    "other prior": [0.30, 0.10, 0.002, 0.0, 0.598],
}
LEVEL_DBA = {"level alone": 55.0, "other prior": 57.0}


def with_alternatives(options: tuple[str, ...] = ("none",)) -> xr.Dataset:
    """Results whose samples have 0.8 to 1.2 of these shares, levels 2 dB off, if worth 100."""
    results = with_sources({name: 62.0 if name == "rattles" else 40.0 for name in options})
    names = {"alternative": [*SHARE]}
    by_part = {**names, "energy_part": PARTS}
    share, level = [*SHARE.values()], [*LEVEL_DBA.values()]
    made = {"alternative_effective": stamp("alternative_effective", [100.0, 200.0], names)}
    for suffix, factor, off_db in (("", 1.0, 0.0), ("_10_percent", 0.8, -2.0),
                                   ("_90_percent", 1.2, 2.0)):  # fmt: skip
        of_parts = [[factor * value for value in row] for row in share]
        name = f"alternative_share{suffix}"
        made[name] = stamp(name, of_parts, by_part)
        name = f"alternative_level{suffix}"
        made[name] = stamp(name, [one + off_db for one in level], names)
    return results.assign(made)


@pytest.fixture(scope="module")
def results() -> xr.Dataset:
    return with_alternatives()


def plain(text: str) -> str:
    return text.replace("\u00a0", " ")


def test_the_sentence_is_about_the_source_that_the_spectrum_changes_most(
    results: xr.Dataset,
) -> None:
    sentence = plain(spectrum_sentence(results))
    assert sentence.startswith("With the published spectral share gas forces make 30 %")
    assert "The share with the level alone is 70 % (56 % to 84 %)" in sentence
    assert spectrum_sentence(results.isel(alternative=[1])) == ""
