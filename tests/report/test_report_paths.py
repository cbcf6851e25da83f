"""The section on the paths of sound: tables, shares with signs, feet, CSV."""

import csv
import io

import numpy as np
import pytest
from pages import page_of
from support import tiny_run

from vibroacoustics.report.blocks import Part
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.paths.tables import (
    foot_table,
    leading,
    leading_sentence,
    orders_table,
    partial_sums_table,
    paths_data,
    paths_table,
    phasor_shares,
    relation,
)
from vibroacoustics.report.tables import to_csv


@pytest.fixture(scope="module")
def results():
    return tiny_run()


def number(cell):
    return float(cell.replace("\u00a0%", "").replace("−", "-").replace("<", ""))


def test_shares_of_phasors_add_up_and_carry_signs():
    share = phasor_shares(np.array([3.0 + 1.0j, -1.0 + 0.5j, 0.0j]))
    np.testing.assert_allclose(share, [(3.0 * 2.0 + 1.5) / 6.25, (-2.0 + 0.75) / 6.25, 0.0])
    assert not phasor_shares(np.array([1.0 + 0.0j, -1.0 + 0.0j])).any()  # silence has no shares


def test_relation_is_the_cosine_to_the_sum():
    p, total = 3.0 * np.exp(1j * np.arccos(0.6)), 5.0
    share = (p * total).real / total**2
    alone_db, total_db = 20.0 * np.log10(abs(p)), 20.0 * np.log10(total)
    assert relation(share, alone_db, total_db) == "works with it (+0.60)"
    assert relation(-share, alone_db, total_db) == "works against it (−0.60)"
    assert relation(0.0, alone_db, total_db) == "across it (0.00)"


def test_leading_paths_are_the_largest_shares_of_any_sign():
    assert leading(np.array([0.2, -0.6, 0.0, 1.4, 0.0001])) == [3, 1, 0]


def test_table_of_paths_tells_how_they_add_up(results):
    table = paths_table(results, "front_1m")
    shares = [number(row[3]) for row in table.rows]
    assert shares == sorted(shares, key=abs, reverse=True)
    assert number(table.rows[-1][4]) == pytest.approx(100.0, abs=1.0)
    assert all(row[1].startswith("housing ") for row in table.rows)
    assert table.rows[0][1].removeprefix("housing ") in leading_sentence(results, "front_1m")


def test_last_partial_sum_is_the_order(results):
    table = partial_sums_table(results, "front_1m", 1.0)
    level = results["order_level"].sel(order=1, option="none", weighting="Z", receiver="front_1m")
    assert number(table.rows[-1][5]) == pytest.approx(level.item(), abs=0.06)
    rows = orders_table(results, "front_1m").rows
    assert rows[0][0] == "1×"
    assert not any("<" in row[1] for row in rows)  # what is silent is not shown


def test_forces_of_the_feet_are_those_of_the_results(results):
    row = foot_table(results, 2900.0).rows[0]
    force = results["foot_force_order"].sel(option="none", foot="front_left", axis="x", order=1)
    assert row[:2] == ("front left", "x")
    assert number(row[2]) == pytest.approx(abs(force.sum("source").item()), rel=5e-3)


def test_files_of_the_report(results):
    rows = list(csv.DictReader(io.StringIO(to_csv(paths_data(results)).decode())))
    shares = [float(r["share_of_modelled_energy"]) for r in rows if r["option"] == "none"]
    assert sum(shares) == pytest.approx(1.0, rel=1e-7)
    section = SECTIONS["paths"]
    assert section.applies(results)
    page = page_of(Part("paths", section.title, tuple(section.blocks(results))))
    assert set(page.pictures()) == {"figures/paths_1_front_1m.svg", "figures/paths_feet.svg"}
    assert "Forces into the feet" in page.html().decode()
