"""Equal quantity, microphone, speed, option and band: one value in all that a report writes."""

import csv
import io
from collections import defaultdict
from collections.abc import Iterator

import numpy as np
import pytest
import xarray as xr
from support import PIPELINES
from test_first_screens import KINDS
from verdicts import contradictions, verdicts

import vibroacoustics as va
from vibroacoustics import report
from vibroacoustics.base.vocabulary import REFERENCE_OPTION
from vibroacoustics.report.charts.marks import Bars
from vibroacoustics.report.figures.paths import at_path_speed, path_speed
from vibroacoustics.report.figures.stacked import stacked_lines, stacked_third_octaves
from vibroacoustics.results.stored_study import catalogue_receiver, nearest_speed
from vibroacoustics.sound.ingredients import ingredients

NINE_DIGITS = 1e-8
SINGLE_DB = 2e-5
"""Levels of lines are kept in single precision until their statistics."""
WITHIN_DB = {"total": 0.01, "order": SINGLE_DB, "source": SINGLE_DB, "order, A": SINGLE_DB}
SILENT_DB = -40.0
SHIPPED = {
    name: PIPELINES / f"{name}.toml"
    for name in ("copeland_sources", "rolling_piston_sources", "kitchen")
}
Key = tuple[object, ...]
"""Quantity, option, speed, microphone, and what else the value is of."""
Place = tuple[Key, str, float]


def rows(files: dict[str, bytes], name: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(files.get(name, b"").decode())))


def case(row: dict[str, str]) -> tuple[str, float, str]:
    return row["option"], float(row["speed_rpm"]), row["receiver"]


def of_comparison(results: xr.Dataset, files: dict[str, bytes]) -> Iterator[Place]:
    for row in rows(files, "comparison.csv"):
        option, speed, receiver = case(row)
        for order in (1, 2):
            level = float(row[f"level_{order}x_db"])
            yield ("order", option, speed, receiver, order), "comparison.csv", level
        total = float(row["level_total_dba"])
        yield ("total", option, speed, receiver), "comparison.csv", total
        heard = ingredients(results, option, receiver, speed).a_weighted_db
        yield ("total", option, speed, receiver), "sound", round(heard, 2)


def of_sources(results: xr.Dataset, files: dict[str, bytes]) -> Iterator[Place]:
    point = REFERENCE_OPTION, nearest_speed(results), catalogue_receiver(results)
    for row in rows(files, "sources.csv"):
        share = float(row["share_of_energy"])
        yield ("share", *case(row), row["source"]), "sources.csv", share
    for row in rows(files, "alternatives.csv")[:1]:
        share, total = float(row["share_of_energy"]), float(row["level_total_dba"])
        yield ("share", *point, row["dominant_source"]), "alternatives.csv", share
        yield ("total", *point), "alternatives.csv", total
    if "path_share" in results:
        where = path_speed(results)
        for row in rows(files, "path_orders.csv"):
            key = "order", REFERENCE_OPTION, where, row["receiver"], int(float(row["order"]))
            yield key, "path_orders.csv", float(row["order_level_db"])
    for row in rows(files, "tones.csv"):
        if row["tone"].startswith("order "):
            key = "order", *case(row), int(row["tone"].removeprefix("order "))
            yield key, "tones.csv", float(row["level_db"])


def of_scores(files: dict[str, bytes], is_one_speed: bool) -> Iterator[Place]:
    """Criteria beside the forces; with several speeds they are the worst over these."""
    names = {"foot_force_1x_n": "foot_force_1x_n", "residual_moment_nm": "moment_1x_nm"}
    for row in rows(files, "scores.csv") if is_one_speed else ():
        for criterion, name in names.items():
            if criterion in row:
                yield (name, row["option"]), "scores.csv", float(row[criterion])
    for row in rows(files, "comparison.csv") if is_one_speed else ():
        for name in names.values():
            yield (name, row["option"]), "comparison.csv", float(row[name])


def check(results: xr.Dataset) -> None:
    analysis = report.analysis_of_study(results)
    files = analysis.files()
    places = defaultdict(dict)
    single = results.sizes["speed"] == 1
    every = (
        of_comparison(results, files), of_sources(results, files), of_scores(files, single),
        of_run_up(results),
    )  # fmt: skip
    for key, name, value in (place for places_of in every for place in places_of):
        places[key][name] = value
    compared = {key: of for key, of in places.items() if len(of) > 1}
    assert compared
    for key, of in compared.items():
        spread = np.ptp([*of.values()])
        within = {
            "total": 0.01,
            "order": SINGLE_DB,
            "source": SINGLE_DB,
            "order, A": SINGLE_DB,
        }.get(str(key[0]), 0.0)
        if max(of.values()) > SILENT_DB:
            assert spread <= within + NINE_DIGITS * max(map(abs, of.values())), (key, of)
    paths_add_up(results)
    lines_stay_below(results)
    stacks_add_up(results)
    assert len(list(verdicts(files))) > 2
    assert contradictions(files) == {}


def paths_add_up(results: xr.Dataset) -> None:
    if "path_share" in results and bool(results["path_share"].any()):
        for name in ("path_share", "path_band_share"):
            total = results[name].sum("path")
            heard = total.values[abs(total.values) > 0.0]
            np.testing.assert_allclose(heard, 1.0, atol=5e-3)


def lines_stay_below(results: xr.Dataset) -> None:
    """No A-weighted order is above the A-weighted machine."""
    orders = results["order_level"].sel(weighting="A").max("order")
    assert (orders <= results["level_total"] + SINGLE_DB).all()


def stacks_add_up(results: xr.Dataset) -> None:
    """Bars of sources end at the levels beside them, where shares of paths divide them."""
    if "path_band_share" not in results or not bool(results["path_share"].any()):
        return
    for chart in (stacked_third_octaves(results), stacked_lines(results)):
        (panel,) = chart.panels
        bars = [mark for mark in panel.marks if isinstance(mark, Bars)]
        foot = panel.y.limits[0]
        shown = at_path_speed(results, catalogue_receiver(results))
        level = shown["modelled_band_level"].values
        if chart.name == "stacked_lines":
            level = results["order_level"].sel(
                order=shown["path_order"].values, option=REFERENCE_OPTION, weighting="A",
                speed=path_speed(results), receiver=catalogue_receiver(results),
            ).values  # fmt: skip
        height = foot + np.sum([bar.size for bar in bars], axis=0)
        loud = level > foot + 3.0
        assert abs(height - level)[loud].max() <= 0.6  # parts below 0.3 dB are not drawn


def of_run_up(results: xr.Dataset) -> Iterator[Place]:
    """Pictures over speed and around the machine, at the speeds of the study."""
    for speed in results["speed"].values if "run_up_level" in results else ():
        if speed not in results["run_up_speed"].values:
            continue
        at = results.sel(speed=speed, run_up_speed=speed, option=REFERENCE_OPTION)
        for receiver in map(str, results["receiver"].values):
            key = REFERENCE_OPTION, float(speed), receiver
            one = at.sel(receiver=receiver)
            yield ("total", *key), "run-up", float(one["run_up_level"])
            for source in map(str, results["sound_source"].values):
                for name, place in (("source_level", "sources"), ("run_up_source_level", "run-up")):
                    yield ("source", *key, source), place, float(one.sel(sound_source=source)[name])
            orders = np.intersect1d(one["run_up_order"].values, one["order"].values)
            levels = one["order_level"].sel(order=orders, weighting="A").values.tolist()
            mapped = one["run_up_order_level"].sel(run_up_order=orders).values.tolist()
            for order, level, of_map in zip(orders.tolist(), levels, mapped, strict=True):
                yield ("order, A", *key, order), "orders", level
                yield ("order, A", *key, order), "map over speed", of_map


@pytest.mark.parametrize("kind", KINDS)
def test_every_value_is_one_value(kind: str) -> None:
    check(KINDS[kind]())


@pytest.mark.long
@pytest.mark.parametrize("name", SHIPPED)
def test_every_value_of_a_shipped_study_is_one_value(name: str) -> None:
    check(va.run(va.load_study(SHIPPED[name])))
