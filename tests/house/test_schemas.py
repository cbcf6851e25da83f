"""The shipped schemas are those of the model; every shipped file names its own and fits it."""

import json
import os

import pytest
from support import ROOT
from toml_language_server import SCHEMAS, marked_lines

from vibroacoustics.commands.outcome import SCHEMA
from vibroacoustics.results.data_sheet import data_sheet_schema
from vibroacoustics.study.schema.files import machine_schema, study_schema

OF_KIND = {"study": study_schema, "machine": machine_schema}
FOLDERS = {"pipelines": "study", "tests/studies": "study", "data/machines": "machine"}
FILES = [(file, kind) for name, kind in FOLDERS.items() for file in (ROOT / name).glob("*.toml")]


@pytest.mark.parametrize("kind", OF_KIND)
def test_shipped_schema_is_current(kind: str) -> None:
    """`vibroacoustics schema --out data/schemas` writes them again."""
    assert json.loads((SCHEMAS / f"{kind}.json").read_text()) == OF_KIND[kind]()


def test_shipped_schema_of_a_data_sheet_is_current() -> None:
    assert json.loads((SCHEMAS / "data_sheet.json").read_text()) == data_sheet_schema()


def test_every_file_names_its_schema() -> None:
    for file, kind in FILES:
        path = os.path.relpath(SCHEMAS / f"{kind}.json", file.parent)
        assert file.read_text(encoding="utf-8").startswith(f"#:schema {path}\n"), file


@pytest.mark.parametrize("kind", OF_KIND)
def test_schema_accepts_every_file(kind: str) -> None:
    assert marked_lines(kind, [file for file, of in FILES if of == kind]) == {}


def test_shipped_schema_of_the_envelope_is_current() -> None:
    assert json.loads((SCHEMAS / "envelope.json").read_text()) == SCHEMA
