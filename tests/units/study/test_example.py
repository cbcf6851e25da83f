"""Values of a template: their sources are marked, and the mark holds for the written value."""

import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

from vibroacoustics.commands.starter import MACHINE_NAME, STUDIES, STUDY_NAME, starting_files
from vibroacoustics.study.example import example_sentence, marked, unmarked
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.record import ParameterRecord
from vibroacoustics.study.study import Study

VALUE = re.compile(r'(?m)^(\w+) = \{ value = (-?[\d.e-]+), source = "example: ([^"]*)"')
TABLE = r"(?m)^\[([\w.]+)\]$"


def written(folder: Path, kind: str, **further: str) -> Path:
    """Study of a template, with text that is added to files."""
    for name, content in starting_files(kind).items():
        (folder / name).write_bytes(content + further.get(name.partition(".")[0], "").encode())
    return folder / STUDY_NAME


def examples(study: Study) -> set[str]:
    return {record.field for record in study.records if record.example}


def stale(study: Study) -> set[str]:
    return {record.field for record in study.records if record.stale}


@pytest.mark.parametrize(
    ("quantity", "mark"),
    [
        ("mass_kg = { value = 0.0727, source = ", "example: 0.0727 kg; "),
        ("turns = { value = 3, source = ", "example: 3; "),
        ("z_mm = { value = -1e-3, source = ", "example: -0.001 mm; "),
        ("x_mm = { value = [65.0, 55], source = ", "example: [65, 55] mm; "),
        ('branch = { value = "left", source = ', "example: left; "),
        ("# mass_g = { value = 1.5, source = ", "example: 1.5 g; "),
    ],
)
def test_mark(quantity: str, mark: str, tmp_path: Path) -> None:
    text = marked(f'{quantity}"thesis; 7.1" }}', {})
    assert text == f'{quantity}"{mark}thesis; 7.1" }}'
    ((key, value),) = tomllib.loads(text.removeprefix("# ")).items()
    own = unmarked(value["source"], key, value["value"], tmp_path)
    assert own == ("thesis; 7.1", True)


@pytest.mark.parametrize("value", [0.0728, 0.07270000001, -0.0727, [0.0727], 10**400])
def test_mark_of_another_value_is_stale(value: object, tmp_path: Path) -> None:
    source = "example: 0.0727 kg; thesis 7.1"
    assert unmarked(source, "mass_kg", value, tmp_path) == (source, False)


@pytest.mark.parametrize("source", ["measured", "example", "example: 0.0727 kg", "an example: 1"])
def test_no_mark(source: str, tmp_path: Path) -> None:
    assert unmarked(source, "mass_kg", 0.0727, tmp_path) == (source, False)


def test_another_file_of_the_name_is_another_value(tmp_path: Path) -> None:
    study = written(tmp_path, "table")
    table = tmp_path / "reciprocating_forces.csv"
    assert "forces.file" in examples(load_study(study))
    table.write_text(table.read_text().replace(".0,", ".00,", 1))
    changed = load_study(study)
    assert "forces.file" not in examples(changed)
    assert stale(changed) == {"forces.file"}


@pytest.mark.parametrize("kind", STUDIES)
def test_every_source_of_a_template_is_marked(kind: str, tmp_path: Path) -> None:
    text = "".join(starting_files(kind)[name].decode() for name in (STUDY_NAME, MACHINE_NAME))
    sources = re.findall(r'value = .*source = "(.*?);', text)
    assert len(sources) > 30
    assert all(source.startswith("example: ") for source in sources)
    study = load_study(written(tmp_path, kind))
    assert not stale(study)
    computed = {record.field for record in study.records if "computed" in record.source}
    assert examples(study) == {record.field for record in study.records} - computed


@pytest.mark.filterwarnings("ignore:.*usual is")
@pytest.mark.parametrize("number", range(3))
def test_changed_values_leave_the_count(number: int, tmp_path: Path) -> None:
    """Some values a hair off; of half of them the source is written anew."""
    before = examples(load_study(written(tmp_path, "table")))
    file = tmp_path / MACHINE_NAME
    text, generator = file.read_text(), np.random.default_rng(number)
    values = list(VALUE.finditer(text))
    chosen = generator.choice(len(values), 8, replace=False).tolist()
    renewed = set(chosen[:4])
    fields = [f"{re.findall(TABLE, text[: value.start()])[-1]}.{value[1]}" for value in values]
    changed = {fields[at] for at in chosen}
    for at in sorted(chosen, reverse=True):
        key, value, source = values[at].groups()
        other = f"{float(value) * (1.0 + 1e-6) or 1e-6:.12g}"
        mark = f"example: {source}" if at not in renewed else "measured"
        quantity = f'{key} = {{ value = {other}, source = "{mark}"'
        text = text[: values[at].start()] + quantity + text[values[at].end() :]
    file.write_text(re.sub(r", range = \[[^\]]*\]", "", text).replace("; assumed", "; derived"))
    study = load_study(tmp_path / STUDY_NAME)
    assert len(changed & before) > len(chosen) / 2
    assert examples(study) == before - changed
    assert stale(study) == {fields[at] for at in set(chosen) - renewed} & before


def test_a_source_written_anew_leaves_the_count(tmp_path: Path) -> None:
    study = written(tmp_path, "oldham-scroll")
    file = tmp_path / MACHINE_NAME
    file.write_text(file.read_text().replace("example: 0.0727 kg; thesis 7.1", "weighed"))
    assert "oldham.mass_kg" not in examples(load_study(study))
    assert not stale(load_study(study))


@pytest.mark.filterwarnings("ignore:.*contradict themselves")
def test_values_that_are_not_read_do_not_count(tmp_path: Path) -> None:
    """The residual unbalance is a source: its table counts where the study has it."""
    for name, content in starting_files("oldham-scroll", with_sources=True).items():
        (tmp_path / name).write_bytes(content)
    study = tmp_path / STUDY_NAME
    with_source = examples(load_study(study))
    table = tomllib.loads((tmp_path / MACHINE_NAME).read_text())["balance_quality"]
    of_table = {f"balance_quality.{key}" for key, value in table.items() if "value" in value}
    assert of_table
    assert of_table <= with_source
    text, count = re.subn(r'\[sources\.\w+\]\nkind = "residual-unbalance"\n', "", study.read_text())
    assert count == 1
    study.write_text(text)
    assert not of_table & examples(load_study(study))


def test_source_of_an_example_is_its_own(tmp_path: Path) -> None:
    records = load_study(written(tmp_path, "oldham-scroll")).records
    (ring,) = (record for record in records if record.field == "oldham.mass_kg")
    assert ring == ParameterRecord(
        file="machine.toml",
        field="oldham.mass_kg",
        value="0.0727",
        unit="kg",
        source="thesis 7.1",
        example=True,
    )
    (scroll,) = (record for record in records if record.field == "orbiting_scroll.mass_kg")
    assert scroll.assumed


def test_sentence() -> None:
    assert example_sentence(31, 44) == "31 of 44 values that this study reads are the example's."
    assert example_sentence(1, 44) == "1 of 44 values that this study reads is the example's."
    assert example_sentence(0, 44) == ""
