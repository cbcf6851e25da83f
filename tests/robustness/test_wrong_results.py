"""Well-hashed results that are no run: `report` and `score` work or refuse them in one line."""

import json
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure
from support import TINY, assert_refused, command_here, made_up_radiation, tiny_run

from vibroacoustics import pipeline
from vibroacoustics.base.hashing import canonical_json, sha256
from vibroacoustics.commands import outputs
from vibroacoustics.results import hashed
from vibroacoustics.results.complete import VARIABLES_OF_A_RUN, WORDS_OF_A_RUN
from vibroacoustics.results.storage import write_results
from vibroacoustics.study.loading import load_study

Change = Callable[[xr.Dataset], xr.Dataset]

run = cache(tiny_run)


@pytest.fixture(autouse=True)
def quick_figures() -> Iterator[None]:
    """Figures are painted and laid out, but their pixels are not made."""
    with patch.object(Figure, "savefig", lambda _, content, **__: content.write(b"\x89PNG")):
        yield


def filled(results: xr.Dataset, name: str, value: float) -> xr.Dataset:
    """One variable or coordinate with the same value everywhere."""
    old = results[name].variable
    new = old.copy(data=np.full(old.shape, value, old.dtype))
    return results.assign({name: new}) if name in results.data_vars else (
        results.drop_vars(name).assign_coords({name: new})
    )  # fmt: skip


def without_attribute(results: xr.Dataset, name: str) -> xr.Dataset:
    kept = results.copy()
    del kept.attrs[name]
    return kept


def with_entry(results: xr.Dataset, attribute: str, key: str, value: object) -> xr.Dataset:
    """An entry of a JSON attribute changed; the hash of the parameters fits."""
    text = canonical_json({**json.loads(results.attrs[attribute]), key: value})
    changed = results.assign_attrs({attribute: text})
    return changed.assign_attrs(parameters_sha256=sha256(changed.attrs["parameters"].encode()))


def refused_or_made(results: xr.Dataset, folder: Path) -> list[int]:
    """Exit codes of both commands; a refusal is one line."""
    (folder / "files.json").unlink(missing_ok=True)  # it would name the files of the last change
    path = write_results(results, folder / "results.nc")
    outcomes = [command_here(name, path) for name in ("score", "report")]
    for outcome in outcomes:
        if outcome.returncode:
            assert_refused(outcome, "results.nc")
    return [outcome.returncode for outcome in outcomes]


def test_the_run_itself_is_made(tmp_path: Path) -> None:
    assert refused_or_made(run(), tmp_path) == [0, 0]


@pytest.mark.parametrize("name", VARIABLES_OF_A_RUN)
def test_a_variable_is_missing(name: str, tmp_path: Path) -> None:
    assert refused_or_made(run().drop_vars(name), tmp_path) == [2, 2]


def test_any_variable_or_coordinate_is_missing(tmp_path: Path) -> None:
    for name in (
        "transfer_vector_error",
        "speed",
        "dof",
        "line_order",
        "criterion_label",
        "distance",
    ):
        refused_or_made(run().drop_vars(name), tmp_path)


@pytest.mark.parametrize("value", [np.nan, 0.0])
def test_a_variable_or_coordinate_holds_one_value(value: float, tmp_path: Path) -> None:
    for name in ("force_amplitude", "transfer_vector", "speed", "natural_frequency"):
        refused_or_made(filled(run(), name, value), tmp_path)


def test_a_dimension_is_empty(tmp_path: Path) -> None:
    for dim in ("option", "speed", "receiver", "mode", "criterion"):
        refused_or_made(run().isel({dim: slice(0)}), tmp_path)


def test_no_option_and_no_reference(tmp_path: Path) -> None:
    assert refused_or_made(run().isel(option=[]), tmp_path) == [2, 2]
    assert refused_or_made(run().isel(option=[1]), tmp_path) == [2, 2]


def test_an_attribute_is_missing_or_wrong(tmp_path: Path) -> None:
    for name in ("parameters", "words", "created_utc", "radiation"):
        refused_or_made(without_attribute(run(), name), tmp_path)
        for value in ("x", "[]", 7.0):
            refused_or_made(run().assign_attrs({name: value}), tmp_path)


@pytest.mark.parametrize("text", ["no JSON", "[1]", "{}", "[" * 100_000])
def test_parameters_are_no_parameters(text: str, tmp_path: Path) -> None:
    changed = run().assign_attrs(parameters=text, parameters_sha256=sha256(text.encode()))
    assert refused_or_made(changed, tmp_path) == [2, 2]


@pytest.mark.parametrize("key", WORDS_OF_A_RUN)
def test_words_are_incomplete(key: str, tmp_path: Path) -> None:
    assert refused_or_made(with_entry(run(), "words", key, None), tmp_path) == [2, 2]


def test_a_hashed_file_that_netcdf_cannot_read(tmp_path: Path) -> None:
    path = tmp_path / "results.nc"
    write_results(run(), path)
    content = bytearray(hashed.read_checked(path).content)
    for start in range(0, len(content), len(content) // 20):
        damaged = content.copy()
        damaged[start : start + 400] = bytes(len(damaged[start : start + 400]))
        path.write_bytes(damaged)
        hashed.append_hash(path)
        outcome = command_here("score", path)
        if outcome.returncode:
            assert_refused(outcome, "results.nc")


def test_forces_that_all_vanish(tmp_path: Path) -> None:
    study = load_study(TINY).replace({"machine.oldham.mass_kg": 1e-30})
    results = pipeline.run(study, radiation=made_up_radiation)
    outputs.write_report(results, tmp_path)
    assert command_here("score", tmp_path / "results.nc").returncode == 0
