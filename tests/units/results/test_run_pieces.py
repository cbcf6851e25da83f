"""Pieces of a run that was interrupted: read again to the same bits, by the same inputs alone."""

import json
import os
import subprocess
import sys
import warnings
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import array_shapes, arrays, scalar_dtypes
from test_lock import hold

from vibroacoustics.base.arrays import Array
from vibroacoustics.base.errors import SchemaError
from vibroacoustics.base.folder import opened_folder
from vibroacoustics.base.forms import has_form, returned
from vibroacoustics.base.pieces import following_from, stored
from vibroacoustics.base.plain_bytes import from_bytes, sha256, to_bytes
from vibroacoustics.base.registry import Origin
from vibroacoustics.design.evaluation import Evaluation
from vibroacoustics.levels.by_source import SourceSound
from vibroacoustics.radiation.revolution.radiator import WallPressure
from vibroacoustics.results import cache, piece_files, run_pieces
from vibroacoustics.results.hashed import hash_line
from vibroacoustics.results.piece_files import PieceFiles
from vibroacoustics.results.run_pieces import resumable, resumed
from vibroacoustics.results.storage import cached
from vibroacoustics.uncertainty.sample_variables import SampleValues

# --- values as bytes -----------------------------------------------------------------------------


def laid_out(array: Any, order: str) -> Any:
    return np.asarray(array, order=order)


ARRAYS = st.builds(
    laid_out,
    arrays(
        scalar_dtypes().filter(lambda kind: kind.kind in "biufc"),
        array_shapes(min_dims=0, min_side=0),
    ),
    st.sampled_from("CF"),
)
NUMBERS = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.complex_numbers(), st.text(),
    ARRAYS, ARRAYS.map(lambda array: array.ravel()[0] if array.size else array),
)  # fmt: skip
VALUES = st.recursive(
    NUMBERS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=3),
        st.lists(inner, max_size=3).map(tuple),
        st.dictionaries(st.tuples(st.floats(allow_nan=False), st.text()), inner, max_size=3),
        st.builds(WallPressure, st.floats(), st.lists(ARRAYS, max_size=2)),
        st.builds(SourceSound, ARRAYS, ARRAYS, ARRAYS),
        st.builds(
            SampleValues, st.dictionaries(st.text(), ARRAYS, max_size=2), inner, inner, inner
        ),
        st.builds(Evaluation, ARRAYS, ARRAYS, st.lists(st.text(), max_size=2).map(tuple)),
    ),
    max_leaves=6,
)


def assert_same(first: Any, second: Any) -> None:
    """Types, bits, and the order of values in memory."""
    assert type(first) is type(second)
    if isinstance(first, np.ndarray | np.generic):
        assert (first.dtype, first.shape) == (second.dtype, second.shape)
        assert first.tobytes("A") == second.tobytes("A")
        assert first.strides == second.strides
        assert first.flags.f_contiguous == second.flags.f_contiguous
        assert first.flags.writeable == second.flags.writeable
    elif isinstance(first, dict):
        assert list(first) == list(second)
        for key in first:
            assert_same(first[key], second[key])
    elif isinstance(first, list | tuple):
        assert len(first) == len(second)
        for one, other in zip(first, second, strict=True):
            assert_same(one, other)
    elif hasattr(first, "__dict__"):
        assert_same(vars(first), vars(second))
    elif isinstance(first, float | complex):
        assert np.array(first).tobytes() == np.array(second).tobytes() or np.isnan(first)
    else:
        assert first == second


@given(VALUES)
def test_value_comes_back_in_every_bit(value: Any) -> None:
    assert_same(from_bytes(to_bytes(value)), value)


@pytest.mark.parametrize(
    "number",
    [np.float64(0.1), np.float32(0.1), np.complex64(1 + 2j), np.int8(3), np.uint64(3), np.bool_(1),
     np.str_("a")],
)  # fmt: skip
def test_scalar_of_an_array_keeps_its_type(number: Any) -> None:
    assert_same(from_bytes(to_bytes([number])), [number])


@pytest.mark.parametrize(
    "value", [object(), {1}, np.array([object()]), Path("a"), print, [np.zeros(1, "datetime64[s]")]]
)
def test_value_of_another_type_is_refused(value: Any) -> None:
    with pytest.raises(TypeError, match="cannot be stored"):
        to_bytes(value)


@pytest.mark.parametrize(
    "text",
    [
        '["os:system","true"]', '["subprocess:Popen","true"]',
        '["vibroacoustics.base.folder:os.system","true"]',
        '["vibroacoustics.base.folder:os","true"]',
        '["vibroacoustics.base.plain_bytes:sha256","true"]',
        '["vibroacoustics.results.run_pieces:RunPieces","true"]',
        '["array",true,"|O","C",1]', '["nothing",1]',
    ],
)  # fmt: skip
def test_bytes_name_no_code(text: str) -> None:
    with pytest.raises((TypeError, ValueError, AttributeError)):
        from_bytes(text.encode() + b"\n" + bytes(8))


def test_bytes_import_no_other_module() -> None:
    with pytest.raises(TypeError, match="cannot be read"):
        from_bytes(b'["this:s",1]\n')
    assert "this" not in sys.modules


# --- runs that are interrupted -------------------------------------------------------------------


class StoppedError(Exception):
    """In place of a signal."""


class Job:
    """Computes values of items, counts them, and stops after some."""

    def __init__(self, most: float = np.inf) -> None:
        self.computed: list[int] = []
        self._most = most

    def value(self, item: int) -> tuple[int, Array]:
        if len(self.computed) == self._most:
            raise StoppedError
        self.computed.append(item)
        return item, np.random.default_rng(item).standard_normal(100)


ITEMS = range(10)


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    return cache.folder()


def no_line(line: str) -> None:
    raise AssertionError(line)


def run(
    job: Job,
    items: Iterable[int] = ITEMS,
    parameters: Any = "a study",
    inputs: Any = "inputs",
    names: tuple[str, ...] = ("work",),
    lines: list[str] | None = None,
) -> list[list[tuple[int, np.ndarray]]]:
    """A run with works of some names."""
    announce = no_line if lines is None else lines.append
    with resumable("run", {"study": parameters}, announce):
        results = []
        for name in names:
            with following_from(lambda: inputs):
                results.append(list(stored(name, items, partial(map, job.value))))
        return results


def interrupted(most: int, **inputs: Any) -> None:
    with pytest.raises(StoppedError):
        run(Job(most), **inputs)


def test_run_computes_what_an_interrupted_one_has_not(own_cache: Path) -> None:
    undisturbed = run(Job())
    assert not list(own_cache.iterdir())  # it ended well
    interrupted(4)
    job, lines = Job(), list[str]()
    assert_same(run(job, lines=lines), undisturbed)
    assert job.computed == [4, 5, 6, 7, 8, 9]
    assert lines == ["continues an interrupted run: 4 of its results are read"]
    assert not list(own_cache.iterdir())


def test_stored_items_may_be_anywhere() -> None:
    interrupted(3, items=[7, 2, 5, 1])
    job = Job()
    assert_same(run(job, lines=[]), run(Job()))
    assert job.computed == [0, 1, 3, 4, 6, 8, 9]


def test_run_interrupted_again_and_again() -> None:
    for lines in (None, [], []):
        interrupted(3, lines=lines)
    job = Job()
    run(job, lines=[])
    assert job.computed == [9]


@pytest.mark.parametrize("changed", [{"parameters": "b"}, {"inputs": "b"}, {"names": ("b",)}])
def test_other_inputs_read_nothing(changed: dict[str, Any]) -> None:
    interrupted(4)
    job = Job()
    run(job, **changed, lines=[])
    assert job.computed == list(ITEMS)


def test_changed_file_of_the_inputs_reads_nothing(tmp_path: Path) -> None:
    file = tmp_path / "body.stl"
    for content, changed in (("a", False), ("b", True)):
        file.write_text("a")
        interrupted(4, inputs={"mesh": [str(file)]}, lines=[])
        file.write_text(content)
        job = Job()
        run(job, inputs={"mesh": [str(file)]}, lines=[])
        assert len(job.computed) == (10 if changed else 6)


@pytest.mark.parametrize("changed", ["_hash_of_sources", "package_versions", "software_version"])
def test_changed_code_reads_nothing(changed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    interrupted(4)
    monkeypatch.setattr(run_pieces, changed, lambda: "changed")
    job = Job()
    run(job)
    assert len(job.computed) == 10


def test_run_with_a_plugin_stores_nothing(monkeypatch: pytest.MonkeyPatch, own_cache: Path) -> None:
    plugins = {"option a": Origin("a.py", "1", "")._asdict()}
    monkeypatch.setattr("vibroacoustics.base.pieces.plugins", lambda: plugins)
    interrupted(4)
    assert not list(own_cache.glob("run-*/*"))


def test_work_of_unknown_inputs_is_not_stored(own_cache: Path) -> None:
    with pytest.raises(StoppedError), resumable("run", {}, no_line):
        list(stored("work", ITEMS, partial(map, Job(4).value)))
    assert not list(own_cache.glob("run-*/*"))


def test_two_works_of_one_name_are_refused() -> None:
    """Also where their first results are read, not computed."""
    interrupted(4)
    for _ in range(2):
        with pytest.raises(RuntimeError, match="name their work apart"):
            clash()


def clash() -> None:
    """Another work of the same name, inputs and items."""
    with resumable("run", {"study": "a study"}, lambda _: None), following_from(lambda: "inputs"):
        list(stored("work", ITEMS, partial(map, Job().value)))
        list(stored("work", ITEMS, lambda items: (Job().value(n + 1) for n in items)))


def test_work_that_is_done_twice_is_the_same() -> None:
    first, again = run(Job(), names=("work", "work"))
    assert_same(first, again)


@pytest.mark.parametrize("damage", ["cut", "flipped", "emptied"])
def test_damaged_file_is_computed_again(damage: str, own_cache: Path) -> None:
    interrupted(4)
    (file,) = own_cache.glob("run-*/pieces_*")
    content = bytearray(file.read_bytes())
    content[len(content) // 2] ^= 1
    file.write_bytes({"cut": content[:90], "flipped": content, "emptied": b""}[damage])
    with pytest.warns(UserWarning, match="computed again"):
        interrupted(2)
    job = Job()
    assert_same(run(job, lines=[]), run(Job()))
    assert job.computed == list(ITEMS[2:])


def other_content(folder: Path, piece: Any) -> None:
    """Put another piece in the place of every piece, with the right hash."""
    (file,) = folder.glob("pieces_*")
    keys = json.loads(file.read_bytes().partition(b"\n")[0])
    file.unlink()
    content = piece if isinstance(piece, bytes) else to_bytes(piece)
    with opened_folder(folder) as opened:
        files = PieceFiles(opened)
        for key in keys:
            files.keep(key, content)
        files.write()


def stacked(job: Job) -> np.ndarray:
    """What a work makes of its pieces; it takes those of 100 values only."""
    with following_from(lambda: "inputs"):
        stream = partial(map, job.value)
        pieces = [each for _, each in stored("work", ITEMS, stream, returned(job.value))]
    if np.shape(pieces) != (len(ITEMS), 100):
        raise SchemaError("pieces: have another shape")
    return np.array(pieces)


def finished(job: Job) -> np.ndarray:
    return resumed("run", {"study": "a study"}, lambda _: None, partial(stacked, job))


OTHER: dict[str, Any] = {
    "kind": "a text",
    "kind of its parts": ("1", np.zeros(100)),
    "number of parts": (1, np.zeros(100), 2.0),
    "shape": (1, np.zeros(7)),
    "type of numbers": (1, np.zeros(100, dtype=np.float32)),
    "complex numbers": (1, np.zeros(100, dtype=complex)),
    "empty": b"",
    "garbage": bytes(range(256)),
    "JSON of another form": b'{"array":[1,2,3]}\n',
    "too short": to_bytes((1, np.zeros(100)))[:-8],
    "negative size": b'["array",true,"<f8","C",-1]\n',
    "deep": b"[" * 5000,
    "a class of the package": b'["vibroacoustics.base.folder:Folder",1]\n',
}


@pytest.mark.parametrize("other", OTHER)
def test_piece_of_the_right_hash_and_other_content_is_computed_again(
    other: str, own_cache: Path
) -> None:
    undisturbed = finished(Job())
    with pytest.raises(StoppedError):
        finished(Job(4))
    (folder,) = own_cache.glob("run-*/")
    other_content(folder, OTHER[other])
    job = Job()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        again = finished(job)
    assert_same(again, undisturbed)
    assert sorted(set(job.computed)) == list(ITEMS)
    assert [str(each.message) for each in caught] == [
        f"{folder}: stored results do not fit; they are computed again"
    ]
    assert not list(own_cache.iterdir())


@pytest.mark.parametrize(
    "content",
    [b"", b"\n", b"[1, 2]\n12", b"{}", b'{"a": "b"}\n1', b'{"a": -1}\n', b'{"a": 9}\n1',
     bytes(99), b'{"a": 1e9}\n', b'{"a": 1, "b": null}\n1', b"[" * 9000 + b"\n",
     b'{"a": 3}\n12345'],
)  # fmt: skip
def test_file_of_the_right_hash_that_holds_no_pieces(content: bytes, own_cache: Path) -> None:
    interrupted(4)
    (file,) = own_cache.glob("run-*/pieces_*")
    file.write_bytes(content + hash_line(sha256(content)))
    job = Job()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert_same(run(job, lines=[]), run(Job()))
    assert job.computed == list(ITEMS)
    assert len(caught) == 1


def test_file_of_another_name_is_no_file_of_pieces(own_cache: Path) -> None:
    interrupted(4)
    (file,) = own_cache.glob("run-*/pieces_*")
    for name in ("pieces_x.bin", "pieces_00000009.bin.old", "pieces_"):
        (file.parent / name).write_bytes(b"other")
    job = Job()
    run(job, lines=[])
    assert job.computed == list(ITEMS[4:])


def test_an_error_of_the_work_itself_is_raised_once() -> None:
    with pytest.raises(StoppedError):
        finished(Job(4))
    calls: list[int] = []

    def refused() -> None:
        calls.append(1)
        raise SchemaError("of the work")

    with pytest.raises(SchemaError):  # no piece was read
        resumed("run", {"study": "a study"}, lambda _: None, refused)
    assert len(calls) == 1


def test_forms_of_values() -> None:
    array = np.zeros(3)
    wall = WallPressure(1.0, [np.zeros((2, 2), dtype=complex)])
    assert has_form(wall, WallPressure)
    assert has_form([wall], list[WallPressure])
    assert not has_form(WallPressure(1.0, [array]), WallPressure)
    assert has_form(Evaluation(array, array, ("a",)), Evaluation)
    assert not has_form(Evaluation(array, array.astype(int), ("a",)), Evaluation)
    assert has_form((None, None), tuple[int | None, str | None])
    assert not has_form(True, float)
    assert has_form({"a": array}, dict[str, np.ndarray])
    assert not has_form({1: array}, dict[str, np.ndarray])
    assert has_form(object(), Any)


def test_second_run_at_the_same_time_stores_nothing(
    own_cache: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_pieces, "_LOCK_S", 0.2)
    interrupted(4)
    (folder,) = own_cache.glob("run-*/")
    before = [file.read_bytes() for file in sorted(folder.iterdir())]
    process = hold(own_cache / cache.lock_of(folder.name), 60)
    try:
        job = Job()
        run(job)
        assert job.computed == list(ITEMS)
        with cache.opened() as opened:
            assert cache.clear(opened) == []  # the other run goes on
        assert [file.read_bytes() for file in sorted(folder.iterdir())] == before
    finally:
        process.kill()
        process.wait()
    with cache.opened() as opened:
        entries = cache.entries(opened)
        assert [entry.name for entry in entries] == [folder.name]
        assert entries[0].size_bytes == sum(map(len, before))
        assert len(cache.clear(opened)) == 1
    assert not list(own_cache.iterdir())


def test_limit_of_the_cache_is_kept(own_cache: Path) -> None:
    interrupted(9)
    (file,) = own_cache.glob("run-*/pieces_*")
    with cache.opened() as opened:
        cache.set_limit(opened, file.stat().st_size // 2)
        assert len(cache.tidy(opened)) == 1
    interrupted(9)
    lines = list[str]()
    run(Job(), lines=lines)
    assert 1 <= int(lines[0].split()[4]) <= 5


def total(folder: Path) -> int:
    """Size of all files of the cache but that of its limit."""
    files = (file for file in folder.rglob("*") if file.is_file())
    return sum(file.stat().st_size for file in files if file.name != cache.LIMIT_NAME)


@pytest.mark.parametrize("entries", [0, 1, 8])
def test_results_and_an_interrupted_run_keep_the_limit_together(
    own_cache: Path, entries: int
) -> None:
    """Also one that is interrupted again; least recently used results go for its pieces."""
    results = xr.Dataset({"a": ("x", np.random.default_rng(7).standard_normal(500))})
    cached("kind", {"a": -1}, lambda: results)
    limit = 3 * total(own_cache)
    with cache.opened() as opened:
        cache.set_limit(opened, limit)
    for number in range(entries):
        cached("kind", {"a": number}, lambda: results)
        assert total(own_cache) <= limit
    for most in (5, 15, 15):
        with pytest.raises(StoppedError):
            run(Job(most), range(60), lines=[])
        assert total(own_cache) <= limit
        assert list(own_cache.glob("run-*/pieces_*"))
    assert total(own_cache) > 0.5 * limit


def test_lower_limit_of_an_interrupted_run(own_cache: Path) -> None:
    interrupted(9)
    limit = total(own_cache) - 1
    with cache.opened() as opened:
        cache.set_limit(opened, limit)
    interrupted(9)
    assert 0 < total(own_cache) <= limit


def test_cache_that_cannot_be_written_costs_a_warning(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def full(*_: Any) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch, warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        patch.setattr(piece_files, "BATCH_S", 0.0)
        patch.setattr("vibroacoustics.base.folder.os.fsync", full)
        results = run(Job())
    assert ["the run goes on without it" in str(one.message) for one in caught] == [True]
    assert_same(results, run(Job()))


def test_short_run_writes_nothing(own_cache: Path) -> None:
    job = Job()

    def values(items: Iterable[int]) -> Iterator[Any]:
        for item in items:
            assert not list(own_cache.glob("run-*/*"))
            yield job.value(item)

    with resumable("run", {}, no_line), following_from(lambda: "inputs"):
        list(stored("work", ITEMS, values))
    assert len(job.computed) == 10


def test_a_copy_of_the_process_stores_nothing(own_cache: Path) -> None:
    code = (
        "import os\n"
        "from vibroacoustics.base.pieces import following_from, stored\n"
        "from vibroacoustics.results import piece_files\n"
        "from vibroacoustics.results.run_pieces import resumable\n"
        "piece_files.BATCH_S = 0.0\n"
        "with resumable('run', {}, print), following_from(lambda: 1):\n"
        "    if not (child := os.fork()):\n"
        "        list(stored('work', [1, 2], lambda items: map(abs, items))); os._exit(0)\n"
        "    os.waitpid(child, 0)\n"
        "    os.kill(os.getpid(), 9)"
    )
    subprocess.run([sys.executable, "-c", code], env=dict(os.environ), check=False)
    assert list(own_cache.glob("run-*/"))
    assert not list(own_cache.glob("run-*/*"))
    with cache.opened() as opened:
        cache.tidy(opened)
    assert not list(own_cache.glob("run-*.lock"))
