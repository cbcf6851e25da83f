"""Level and shares with less evidence and with the second prior, in words."""

import pytest
import xarray as xr
from test_report_sources import with_sources

from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.report.sections.sources.content import alternatives_table, spectrum_sentence

PARTS = ["gas", "keys", "motor", "moving_parts", "unmodelled"]
SHARE = {
    "level alone": [0.70, 0.20, 0.0, 0.0, 0.10],
    "other prior": [0.30, 0.10, 0.002, 0.0, 0.598],
}
LEVEL_DBA = {"level alone": 55.0, "other prior": 57.0}


def with_alternatives() -> xr.Dataset:
    """Results whose samples have 0.8 to 1.2 of these shares, levels 2 dB off, if worth 100."""
    results = with_sources({"none": 40.0})
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


def test_table_has_level_and_share_of_every_part_by_alternative(results: xr.Dataset) -> None:
    table = alternatives_table(results)
    assert table is not None
    assert table.head[1:] == ("all data, first prior", "published level alone", "second prior")
    assert "100 with published level alone, 200 with second prior" in table.caption
    rows = {row[0]: [plain(cell) for cell in row[1:]] for row in table.rows}
    # Interval of 4 dB over √100 times 0.667 and 0.489: 0.27 and 0.2 dB.
    assert rows["Level of the machine, dB(A)"][1:] == [
        "55.0 (53.0 to 57.0)", "57.0 (55.0 to 59.0)",
    ]  # fmt: skip
    assert rows["Share of gas forces"] == [
        "30 % (10 % to 50 %)", "70 % (56 % to 84 %)", "30 % (24 % to 36 %)",
    ]  # fmt: skip
    assert "Share of motor at twice the line frequency" not in rows  # below 1 % everywhere
    assert rows["Share of unmodelled noise"][1] == "10 % (8 % to 12 %)"
    assert len(rows) < 1 + len(PARTS)
    assert alternatives_table(results.drop_dims("alternative")) is None


def test_the_sentence_is_about_the_source_that_the_spectrum_changes_most(
    results: xr.Dataset,
) -> None:
    sentence = plain(spectrum_sentence(results))
    assert sentence.startswith("With the published spectral share gas forces make 30 %")
    assert "with the level alone 70 % (56 % to 84 %)" in sentence
    assert spectrum_sentence(results.isel(alternative=[1])) == ""
