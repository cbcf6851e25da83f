"""The section on the paths of sound: tables, shares with signs, feet, CSV."""

import csv
import io

import numpy as np
import pytest
from pages import page_of
from support import tiny_run

from vibroacoustics.report.blocks import Part
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.paths import (
    leading,
    leading_sentence,
    orders_table,
    path_data,
    paths_data,
    paths_table,
    relation,
)
from vibroacoustics.report.tables import records, to_csv


@pytest.fixture(scope="module")
def results():
    return tiny_run()


def number(cell):
    return float(cell.replace("\u00a0%", "").replace("−", "-").replace("<", ""))


def test_relation_is_the_cosine_to_the_sum():
    assert relation(1.0) == "works with it (+1.00)"
    assert relation(0.6) == "works with it (+0.60)"
    assert relation(-0.6) == "works against it (−0.60)"
    assert relation(0.0) == "across it (0.00)"


def test_leading_paths_are_the_largest_shares_of_any_sign():
    assert leading(np.array([0.2, -0.6, 0.0, 1.4, 0.0001])) == [3, 1, 0]


def test_table_of_paths_tells_how_they_add_up(results):
    table = paths_table(results, "front_1m")
    shares = [number(row[3]) for row in table.rows]
    assert shares == sorted(shares, key=abs, reverse=True)
    every = records(paths_data(results))
    own = [row for row in every if row["receiver"] == "front_1m"]
    last = min(own, key=lambda row: abs(row["share_of_modelled_energy"]))
    assert last["share_so_far"] == pytest.approx(1.0, rel=1e-6)
    assert all(row[1].startswith("housing ") for row in table.rows)
    assert table.rows[0][1].removeprefix("housing ") in leading_sentence(results, "front_1m")


def test_shares_of_an_order_add_up_beside_its_level(results):
    table = records(path_data(results)["path_orders.csv"])
    own = [row for row in table if (row["receiver"], row["order"]) == ("front_1m", 1.0)]
    level = results["order_level"].sel(order=1, option="none", weighting="Z", receiver="front_1m")
    assert {row["order_level_db"] for row in own} == {level.item()}
    assert sum(row["share"] for row in own) == pytest.approx(1.0, rel=1e-6)
    assert all(-1.0 <= row["cosine_to_sum"] <= 1.0 for row in own)
    assert (
        np.sign([row["share"] for row in own]).tolist()
        == np.sign([row["cosine_to_sum"] for row in own]).tolist()
    )
    rows = orders_table(results, "front_1m").rows
    assert rows[0][0] == "1×"
    assert not any("<" in row[1] for row in rows)  # what is silent is not shown


def test_forces_of_the_feet_are_those_of_the_results(results):
    row = records(path_data(results)["feet.csv"])[0]
    force = results["foot_force_order"].sel(option="none", foot="front_left", axis="x", order=1)
    assert (row["foot"], row["axis"]) == ("front_left", "x")
    assert row["all_sources_peak_n"] == pytest.approx(abs(force.sum("source").item()))


def test_files_of_the_report(results):
    rows = list(csv.DictReader(io.StringIO(to_csv(paths_data(results)).decode())))
    shares = [float(r["share_of_modelled_energy"]) for r in rows]
    assert sum(shares) == pytest.approx(len({r["receiver"] for r in rows}), rel=1e-6)
    section = SECTIONS["paths"]
    assert section.applies(results)
    page = page_of(Part("paths", section.title, tuple(section.blocks(results))))
    drawn = {name for name in page.files() if name.startswith("figures/")}
    assert drawn == {"figures/paths_1_front_1m.svg", "figures/paths_feet.svg"}
    assert "Forces into the feet" in page.html().decode()
