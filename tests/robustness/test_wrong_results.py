"""Well-hashed results that are no run: `report` and `score` work or refuse them in one line."""

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any, Final
from unittest.mock import patch

import numpy as np
import pytest
import xarray as xr
from sources_study import sources_run
from support import TINY, append_hash, assert_refused, command_here, made_up_radiation, tiny_run

from vibroacoustics import pipeline, report
from vibroacoustics.base.errors import SchemaError
from vibroacoustics.base.plain_bytes import sha256
from vibroacoustics.base.vocabulary import (
    COORDINATES,
    LOW,
    REFERENCE_OPTION,
    SUFFIXES,
    VARIABLES,
    YES_OR_NO,
)
from vibroacoustics.commands import outputs
from vibroacoustics.report.drawing import machine as drawn
from vibroacoustics.results import hashed
from vibroacoustics.results.complete import check_run
from vibroacoustics.results.run_attributes import Parameters, Words
from vibroacoustics.results.run_variables import (
    COORDINATES_OF,
    needed_variables,
)
from vibroacoustics.results.storage import write_results
from vibroacoustics.study.loading import load_study

RUNS: Final = {
    "rigid": tiny_run,
    "sources": sources_run,  # with samples and a stop
}
ATTRIBUTES: Final = {"parameters": Parameters, "words": Words}
GONE: Final = object()
EMPTY: Final = {
    name
    for registry in (VARIABLES, COORDINATES)
    for name, labelled in registry.items()
    if labelled.missing
}
TRUTHS: Final = {name for name, one in VARIABLES.items() if one.bounds == YES_OR_NO}
"""Whose values are 0 to 1: `True` is one."""
POSITIVE: Final = {
    "mass_kg", "level_dba", "outer_diameter_m", "height_m", "length_m", "width_m", "diameter_m",
    "distance_m",
}  # fmt: skip
"""Numbers without which nothing can be drawn."""
both = pytest.mark.parametrize("name", RUNS)
both_at_length = pytest.mark.parametrize(
    "name", ["rigid", pytest.param("sources", marks=pytest.mark.long)]
)


@cache
def run(name: str = "rigid") -> xr.Dataset:
    return RUNS[name]()


def scored_here(path: Path) -> CompletedProcess[str]:
    """The command `score` but for its report, which `report` makes of the same results."""
    with patch.object(outputs, "write_report", lambda _, folder: folder):
        return command_here("score", path)


def refused_or_made(results: xr.Dataset, folder: Path) -> list[int]:
    """Exit codes of both commands; a refusal is one line that names the file."""
    (folder / "files.json").unlink(missing_ok=True)  # it would name the files of the last change
    path = folder / "results.nc"
    with patch.object(outputs.storage, "open_with_hash", lambda _: (results, "0" * 64)):
        outcomes = [scored_here(path), command_here("report", path)]
    for outcome in outcomes:
        if outcome.returncode:
            assert_refused(outcome, "results.nc")
            assert outcome.stderr.count("\n") == 1, outcome.stderr
    return [outcome.returncode for outcome in outcomes]


def assert_no_run(results: xr.Dataset) -> None:
    with pytest.raises(SchemaError):
        check_run(results)


def with_values(results: xr.Dataset, name: str, values: Any, dims: Any = None) -> xr.Dataset:
    """Other values of a variable or coordinate, with its attributes."""
    old = results[name].variable
    new = xr.Variable(old.dims if dims is None else dims, values, old.attrs)
    if name in results.data_vars:
        return results.assign({name: new})
    return results.drop_vars(name).assign_coords({name: new})


def filled(results: xr.Dataset, name: str, value: Any) -> xr.Dataset:
    return with_values(results, name, np.full(results[name].shape, value))


def without_attribute(results: xr.Dataset, name: str) -> xr.Dataset:
    kept = results.copy()
    del kept.attrs[name]
    return kept


def with_json(results: xr.Dataset, attribute: str, value: object) -> xr.Dataset:
    """A JSON attribute replaced; the hash of the parameters fits."""
    changed = results.assign_attrs({attribute: json.dumps(value)})
    return changed.assign_attrs(parameters_sha256=sha256(changed.attrs["parameters"].encode()))


def leaves(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    """Everything in a JSON value with its path; of a list the first item alone."""
    if path:
        yield path, value
    items = list(enumerate(value))[:1] if isinstance(value, list) else ()
    for key, item in value.items() if isinstance(value, dict) else items:
        yield from leaves(item, (*path, key))


def replaced(value: Any, path: tuple[Any, ...], new: object) -> Any:
    """A JSON value with another one at a path, or without it."""
    key, *rest = path
    copied = value.copy()
    if rest:
        copied[key] = replaced(value[key], tuple(rest), new)
    elif new is GONE:
        del copied[key]
    else:
        copied[key] = new
    return copied


def known_keys(results: xr.Dataset, attribute: str) -> Any:
    """A JSON attribute without the keys that no report reads."""
    model = ATTRIBUTES[attribute].model_validate_json(results.attrs[attribute])
    return model.model_dump(mode="json", exclude_unset=True)


@both_at_length
def test_the_run_itself_is_made(name: str, tmp_path: Path) -> None:
    results = run(name)
    if name == "rigid":
        path = write_results(results, tmp_path / "results.nc")
        assert [command_here(verb, path).returncode for verb in ("score", "report")] == [0, 0]
    assert refused_or_made(results, tmp_path) == [0, 0]


@both_at_length
def test_what_is_checked_is_all_that_a_report_reads(name: str) -> None:
    """Without the variables and keys that no check knows it is the same."""
    results = run(name)
    optional = {"supply_frequency", "projection_error", "force", "transfer_vector_closed_form",
                "transfer_vector_error", "stopping_order_map", "rank_acceptability",
                "total_band_level", "alternative_effective",
                *drawn.NEEDED}  # fmt: skip
    with_interval = [name for name in map(str, results) if f"{name}{SUFFIXES[LOW]}" in results]
    sampled = {name + suffix for name in with_interval for suffix in ("", *SUFFIXES.values())}
    needed = {*needed_variables(results), *optional, *sampled} & results.keys()
    reduced = results[sorted(needed)]
    beside = {*reduced.dims, *(name for one in needed for name in COORDINATES_OF.get(one, ()))}
    reduced = reduced.drop_vars([name for name in reduced.coords if name not in beside])
    for attribute in ("parameters", "words"):
        reduced = with_json(reduced, attribute, known_keys(results, attribute))
    check_run(reduced)
    files = [report.render(one) for one in (results, reduced)]
    assert files[0].keys() == files[1].keys()
    for file in ("comparison.csv", "scores.csv"):
        assert files[0][file] == files[1][file]
    assert "sources.csv" in files[0] or name == "rigid"


@both_at_length
def test_a_variable_is_missing(name: str, tmp_path: Path) -> None:
    results = run(name)
    for variable in needed_variables(results):
        assert_no_run(results.drop_vars(variable))
    assert refused_or_made(results.drop_vars("level_total"), tmp_path) == [2, 2]


@both_at_length
def test_a_coordinate_is_missing(name: str, tmp_path: Path) -> None:
    results = run(name)
    beside = {one for key, names in COORDINATES_OF.items() for one in names if key in results}
    for coordinate in {*results[list(needed_variables(results))].dims, *beside}:
        assert_no_run(results.drop_vars(coordinate))
    refused_or_made(results.drop_vars([*set(results.coords) - set(results.dims)]), tmp_path)


@both_at_length
@pytest.mark.parametrize("step", [5, pytest.param(1, marks=pytest.mark.long)])
def test_a_variable_or_coordinate_holds_other_things(name: str, step: int) -> None:
    """No numbers, one that is not finite, dims in another order, all of them text or complex.

    Every so many of all variables.
    """
    results = run(name)
    known = run("rigid").variables if name != "rigid" else {}
    for key in [key for key in results.variables if key not in known][::step]:
        variable = results.variables[key]
        wrong: list[xr.Dataset] = [
            with_values(results, str(key), variable.values[None], ("new", *variable.dims))
        ]
        if variable.dtype.kind == "U":
            wrong.append(filled(results, str(key), 1.0))
        else:
            wrong.append(filled(results, str(key), "x"))
            wrong += [filled(results, str(key), True)] * (key not in TRUTHS)
            wrong += [filled(results, str(key), np.inf)] * (key not in EMPTY)
            spoilt = variable.values.astype(complex if variable.dtype.kind == "c" else float)
            spoilt.flat[-1] = np.nan
            wrong += [with_values(results, str(key), spoilt)] * (key not in EMPTY)
        if len(set(variable.dims)) > 1:
            wrong.append(with_values(results, str(key), variable.values.T, variable.dims[::-1]))
        if key in results.data_vars:
            wrong.append(filled(results, str(key), 1.0 if variable.dtype.kind == "c" else 1j))
        for changed in wrong:
            assert_no_run(changed)


@pytest.mark.parametrize(
    ("name", "value"),
    [("rigid", np.nan), ("rigid", 0.0), ("rigid", 1e300), ("sources", np.nan),
     *(pytest.param("rigid", value, marks=pytest.mark.long) for value in (-1.0, 999.0)),
     *(pytest.param("sources", value, marks=pytest.mark.long) for value in (0.0, 999.0, 1e300))],
)  # fmt: skip
def test_all_that_may_be_so_holds_one_value(name: str, value: float, tmp_path: Path) -> None:
    """Together; numbers of orders and labels of dimensions stay."""
    results = run(name)
    for key, variable in run(name).data_vars.items():
        if np.isfinite(value) or key in EMPTY:
            results = filled(results, str(key), np.full((), value, variable.dtype))
    refused_or_made(results, tmp_path)


@pytest.mark.parametrize("value", [0.0, pytest.param(1e29, marks=pytest.mark.long)])
@pytest.mark.parametrize("key", ["force_amplitude", "transfer_vector", "natural_frequency"])
@pytest.mark.long
def test_a_variable_holds_one_value(key: str, value: float, tmp_path: Path) -> None:
    refused_or_made(filled(run(), key, np.full((), value, run()[key].dtype)), tmp_path)


@pytest.mark.parametrize("value", [0.0, -1.0, 1e29, 1e300])
def test_a_speed_is_none(value: float, tmp_path: Path) -> None:
    refused_or_made(filled(run(), "speed", value), tmp_path)


@both_at_length
def test_a_dimension_is_empty_or_holds_a_label_twice(name: str) -> None:
    results = run(name)
    for dim in results[list(needed_variables(results))].dims:
        assert_no_run(results.isel({dim: slice(0)}))
        assert_no_run(results.isel({dim: [0, *range(results.sizes[dim])]}))


@both_at_length
def test_options_are_gone(name: str, tmp_path: Path) -> None:
    results = run(name)
    assert refused_or_made(results.isel(option=[]), tmp_path) == [2, 2]
    assert refused_or_made(results.isel(option=[1]), tmp_path) == [2, 2]
    assert refused_or_made(results.sel(option=[REFERENCE_OPTION]), tmp_path) == [0, 0]


def test_no_sample_counts() -> None:
    results = run("sources")
    assert_no_run(filled(results, "sample_weight", 0.0))
    unsolved = results.copy(deep=True)
    unsolved["level_total_by_sample"][0] = np.nan
    assert_no_run(unsolved)
    check_run(results)


@pytest.mark.long
def test_an_attribute_is_missing_or_wrong(tmp_path: Path) -> None:
    numbers = np.array([1.0, 2.0])
    for name in ("parameters", "words", "created_utc"):
        assert_no_run(without_attribute(run(), name))
        assert_no_run(run().assign_attrs({name: numbers}))
    for name in ("parameters", "words", "radiation", "plugins", "package_versions"):
        for value in ("x", "[]", 7.0, numbers, "[" * 100_000, '{"a":"\\ud800"}', "1" * 5000):
            changed = run().assign_attrs({name: value})
            digest = sha256(str(changed.attrs["parameters"]).encode())
            assert_no_run(changed.assign_attrs(parameters_sha256=digest))
    refused_or_made(without_attribute(run(), "radiation"), tmp_path)
    assert refused_or_made(run().assign_attrs(words="{}"), tmp_path) == [2, 2]


def test_an_attribute_of_a_variable_is_missing_or_wrong() -> None:
    for name, attribute in (("level_total", "units"), ("supply_frequency", "source")):
        for value in (None, 7.0, np.array([1.0, 2.0])):
            changed = run("sources").copy()
            changed[name].attrs = {**changed[name].attrs, attribute: value}
            assert_no_run(changed)


@pytest.mark.parametrize("text", ["no JSON", "[1]", "{}", "[" * 100_000])
def test_parameters_are_no_parameters(text: str, tmp_path: Path) -> None:
    changed = run().assign_attrs(parameters=text, parameters_sha256=sha256(text.encode()))
    assert refused_or_made(changed, tmp_path) == [2, 2]


@both_at_length
@pytest.mark.parametrize("attribute", ATTRIBUTES)
@pytest.mark.parametrize("step", [31, pytest.param(1, marks=pytest.mark.long)])
def test_a_key_is_missing_or_of_another_type(
    name: str, attribute: str, step: int, tmp_path: Path
) -> None:
    """Refused, or made where the key can be missing: every so many of all keys."""
    results = run(name)
    stored = json.loads(results.attrs[attribute])
    made = {}
    for path, value in list(leaves(known_keys(results, attribute)))[::step]:
        number = isinstance(value, float | int) and not isinstance(value, bool)
        wrong = ["x"] if not isinstance(value, str) else [7]
        for new in (GONE, *wrong, float("nan"), *([[]] if number else [[7]]), {"a": 7}):
            changed = with_json(results, attribute, replaced(stored, path, new))
            try:
                check_run(changed)
            except SchemaError:
                continue
            made[path[:-1], new is GONE] = changed
    for what, changed in list(made.items()):
        assert refused_or_made(changed, tmp_path) == [0, 0], what


@both_at_length
@pytest.mark.parametrize(
    "value",
    [0, 1e29, 10**400, *(pytest.param(one, marks=pytest.mark.long) for one in (-1, 1e300))],
)
def test_every_number_of_the_parameters_is(name: str, value: float, tmp_path: Path) -> None:
    """But the catalogue's speed, at which results with sources must be."""
    results = run(name)
    stored = json.loads(results.attrs["parameters"])
    for path, old in leaves(known_keys(results, "parameters")):
        number = isinstance(old, float | int) and not isinstance(old, bool)
        if number and path[-1] != "speed_rpm" and path[0] != "scoring":
            stored = replaced(stored, path, value)
    refused_or_made(with_json(results, "parameters", stored), tmp_path)
    for path, old in leaves(known_keys(results, "parameters")):
        if path[-1] in POSITIVE or str(path[-1]).startswith("inertia_"):
            stored = replaced(stored, path, old)
    assert refused_or_made(with_json(results, "parameters", stored), tmp_path) == (
        [0, 0] if abs(value) < 1e30 else [2, 2]
    )


@pytest.mark.parametrize(
    ("key", "new"),
    [("criteria", GONE), ("seed", {}),
     *(pytest.param(*case, marks=pytest.mark.long)
       for case in (("criteria", {}), ("criteria", "x"), ("seed", GONE), ("seed", "x")))],
)  # fmt: skip
def test_scoring_is_no_scoring(key: str, new: object, tmp_path: Path) -> None:
    stored = json.loads(run().attrs["parameters"])
    changed = with_json(run(), "parameters", replaced(stored, ("scoring", key), new))
    assert refused_or_made(changed, tmp_path)[0] in (0, 2)


@pytest.mark.parametrize(
    "kept",
    ["x", {}, [1], [{}], [{"name": "a"}],
     [{"name": "a", "title": "A", "position": 1.0, "blocks": [{"block": "text"}]}],
     [{"name": "a", "title": "A", "position": "x", "blocks": []}]],
)  # fmt: skip
def test_kept_sections_are_none(kept: object, tmp_path: Path) -> None:
    changed = run().assign_attrs(report_sections=json.dumps(kept))
    assert refused_or_made(changed, tmp_path) == [2, 2]


@pytest.mark.parametrize("changed", [{}, {"texts": []}, {"head": 7}, {"position": None}])
def test_kept_columns_are_none(changed: dict[str, object], tmp_path: Path) -> None:
    column = {"name": "a", "head": "A", "terminal": None, "texts": {}, "change_of": "",
              "position": 1.0, **changed}  # fmt: skip
    results = run().assign_attrs(report_columns=json.dumps([column]))  # without its values
    assert refused_or_made(results, tmp_path) == [2, 2]


@pytest.mark.parametrize("places", [10, pytest.param(20, marks=pytest.mark.long)])
@pytest.mark.long
def test_a_hashed_file_that_netcdf_cannot_read(places: int, tmp_path: Path) -> None:
    path = tmp_path / "results.nc"
    write_results(run(), path)
    content = bytearray(hashed.read_checked(path).content)
    for start in range(0, len(content), len(content) // places):
        damaged = content.copy()
        damaged[start : start + 400] = bytes(len(damaged[start : start + 400]))
        path.write_bytes(damaged)
        append_hash(path)
        outcome = scored_here(path)
        if outcome.returncode:
            assert_refused(outcome, "results.nc")


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:.*usual is")  # a ring of nearly nothing
def test_forces_that_all_vanish(tmp_path: Path) -> None:
    study = load_study(TINY).replace({"machine.oldham.mass_kg": 1e-30})
    results = pipeline.run(study, radiation=made_up_radiation)
    outputs.write_report(results, tmp_path)
    assert command_here("score", tmp_path / "results.nc").returncode == 0
