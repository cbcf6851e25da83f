"""Published values of a study, from CSV files: what is read, what is refused."""

from pathlib import Path

import pytest
from support import PIPELINES, ROOT, TINY

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.study.loading import load_study


def with_evidence(folder: Path, table: str, csv: str = "") -> Path:
    (folder / "rows.csv").write_text(csv, encoding="utf-8")
    file = folder / "study.toml"
    study = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file.write_text(f"{study}\n{table}" if table.startswith("[") else f"{table}\n{study}")
    return file


def test_the_thesis_study_names_what_is_published() -> None:
    evidence = load_study(PIPELINES / "copeland_sources.toml").evidence
    assert [force.force_1x_n for force in evidence.forces] == [45.3, 65.9]


@pytest.mark.parametrize(
    ("table", "csv", "words"),
    [
        ("evidence = 3\n", "", "evidence = 3: must be a table"),
        ("[evidence]\nweights = 'rows.csv'\n", "", "evidence.weights: unknown key; allowed forces"),
        ("[evidence]\nforces = 3\n", "", "evidence.forces = 3: must be a file name"),
        ("[evidence]\nforces = 'absent.csv'\n", "", "absent.csv: no such file"),
        ("[evidence]\nforces = 'rows.csv'\n", "part,speed_rpm\nring,2900\n", "force_1x_n"),
        ("[evidence]\nforces = 'rows.csv'\n", "part\nring,2\n", "columns found: part"),
        (
            "[evidence]\nforces = 'rows.csv'\n",
            "part,speed_rpm,force_1x_n,deviation_n,source\nring,-1,1,1,thesis\n",
            "speed_rpm",
        ),
    ],
)
def test_refusals_name_the_key(tmp_path: Path, table: str, csv: str, words: str) -> None:
    with pytest.raises(ParameterError, match=words):
        load_study(with_evidence(tmp_path, table, csv))
