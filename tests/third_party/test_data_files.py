"""A data file of a plug-in: its place, its content in hashes, cache keys and results, refusals."""

import json
import re
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import ClassVar

import numpy as np
import pytest
from support import ROOT, TINY, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base import registry
from vibroacoustics.design.engine.engine import _material
from vibroacoustics.design.workers.study_task import study_hash
from vibroacoustics.results.provenance import attributes
from vibroacoustics.study.schema.files import study_schema

POINTS = 360
COSINE_KN = np.cos(2.0 * np.pi * np.arange(POINTS) / POINTS)
SOURCE = """
[sources.bench]
kind = "bench-force"
measured.file = "bench.csv"

[radiation]
"""


@pytest.fixture(autouse=True)
def _plugin(monkeypatch):
    """The plug-in, which is forgotten after the test."""
    modules = set(sys.modules)
    for each in registry._REGISTRIES:
        len(each)  # fills it
        for name in ("_things", "_origins"):
            monkeypatch.setattr(each, name, dict(getattr(each, name)))
    va.load_plugin(ROOT / "tests" / "third_party" / "bench_force.py")
    yield
    for name in set(sys.modules) - modules:
        if name.startswith("plugin_"):
            del sys.modules[name]


def write_force(path: Path, factor: float = 1.0) -> None:
    rows = "".join(f"{factor * value!r}\n" for value in COSINE_KN.tolist())
    path.write_text(f"# one revolution\nforce_kn\n{rows}")


def write_study(folder: Path, source: str = SOURCE) -> Path:
    """The tiny study with a source, and its data file beside it."""
    folder.mkdir()
    write_force(folder / "bench.csv")
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    (folder / "study.toml").write_text(text.replace("[radiation]\n", source))
    return folder / "study.toml"


def design_key(study: va.Study) -> dict:
    """What keys a computed design of the study in the cache."""
    return _material(study, "none", (), SimpleNamespace(key="", content=""))


def test_key_of_a_design_has_all_that_a_criterion_may_read() -> None:
    """Such as the rules of a rating, or which microphone is the published one."""
    study = va.load_study(ROOT / "pipelines" / "neighbour.toml")
    key = design_key(study)
    for change in (
        {"rating.windows.bedroom.operating_min": 30.0},
        {"receivers.window.x_mm": 9000.0},
        {"catalogue_receiver": "left_1m"},
    ):
        assert design_key(study.replace(change)) != key
    assert design_key(study.replace({"title": "another"})) == key


def peak_n(study: va.Study) -> float:
    return max(study.sources["bench"].measured.force_n)


def test_name_is_relative_to_the_file_that_holds_it(tmp_path, monkeypatch):
    """Of the study that is extended, of the study itself, of the working folder in Python."""
    write_study(tmp_path / "base")
    (tmp_path / "own").mkdir()
    over = tmp_path / "own" / "study.toml"
    over.write_text('extends = "../base/study.toml"\n')
    write_force(tmp_path / "own" / "bench.csv", 2.0)
    write_force(tmp_path / "bench.csv", 3.0)
    monkeypatch.chdir(tmp_path)
    assert peak_n(va.load_study(over)) == pytest.approx(1e3)
    over.write_text(over.read_text() + '[sources.bench]\nmeasured.file = "bench.csv"\n')
    study = va.load_study(over)
    assert peak_n(study) == pytest.approx(2e3)
    assert peak_n(study.replace({"sources.bench.measured.file": "bench.csv"})) == pytest.approx(3e3)


def test_content_is_in_hash_cache_key_and_results(tmp_path):
    file = write_study(tmp_path / "first")
    first = va.load_study(file)
    same = va.load_study(write_study(tmp_path / "second"))
    write_force(file.with_name("bench.csv"), 1.0 + 1e-9)
    changed = va.load_study(file)
    assert study_hash(first) == study_hash(same)
    assert study_hash(first) != study_hash(changed)
    assert design_key(first) == design_key(same)
    assert design_key(first) != design_key(changed)
    provenance = attributes(first)
    assert provenance["parameters_sha256"] != attributes(changed)["parameters_sha256"]
    kept = json.loads(provenance["parameters"])["sources"]["bench"]["measured"]
    assert kept == {"file": "bench.csv", "force_n": list(first.sources["bench"].measured.force_n)}


@pytest.mark.long
def test_force_of_the_file_is_in_the_results_without_the_file(tmp_path):
    """Linear between 360 points a cosine of 1 kN lacks π²/(3·360²) = 2.5e-5 of its peak."""
    study = va.load_study(write_study(tmp_path / "study"))
    (tmp_path / "study" / "bench.csv").unlink()
    results = va.run(study, radiation=made_up_radiation)
    force = results["force_order"].sel(source="bench", option="none", axis="x", order=1)
    assert abs(force.item()) == pytest.approx(1e3, rel=3e-5)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, r"bench\.csv: no such file"),
        ("force_n\n1\nx\n", r"bench\.csv: line 3: force_n = x: must be a finite number"),
        ("torque_n_m\n1\n", r"bench\.csv: torque_n_m: unknown column; force_n is missing"),
    ],
)
def test_a_bad_file_is_refused_in_one_line(tmp_path, content, words):
    file = write_study(tmp_path / "study")
    file.with_name("bench.csv").unlink()
    if content is not None:
        file.with_name("bench.csv").write_text(content)
    with pytest.raises(va.ParameterError, match=words) as refusal:
        va.load_study(file)
    line = str(refusal.value)
    assert re.match(rf"{re.escape(str(file))}: sources\.bench\.measured", line)
    assert "\n" not in line


def test_an_option_reads_a_data_file_too(tmp_path):
    class LossFile(va.FileTable):
        content: ClassVar[str] = "loss_db"
        band_hz: tuple[float, ...] = ()
        loss_db: tuple[float, ...] = ()

        @classmethod
        def read(cls, path, table):
            columns = va.read_columns(path, ["band_hz", "loss_db"])
            return {name: tuple(values.tolist()) for name, values in columns.numbers.items()}

    @va.register
    class MeasuredHood(va.Option):
        kind: ClassVar[str] = "measured-hood"
        loss: LossFile

        def insertion_loss(self):
            return va.InsertionLoss(np.array(self.loss.band_hz), np.array(self.loss.loss_db))

    option = '[options.hood]\nkind = "measured-hood"\nloss.file = "hood.csv"\n\n[radiation]\n'
    file = write_study(tmp_path / "study", option)
    file.with_name("hood.csv").write_text("band_hz,loss_db\n500,6\n1000,10\n")
    hood = va.load_study(file).options["hood"]
    assert hood.insertion_loss().at(np.array([1000.0])).tolist() == [10.0]
    assert hood.loss.file == "hood.csv"


def test_schema_names_the_file_alone():
    """An editor offers the name of the file, not the fields that the file fills."""
    definition = study_schema()["$defs"]["ForceFile"]
    assert set(definition["properties"]) == {"file"}
