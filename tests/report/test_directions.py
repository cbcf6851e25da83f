"""Names with bidirectional control characters: pages, pictures and lines show their codes."""

import json
import re

import pytest
from support import TINY, command_here, made_up_radiation

from vibroacoustics import pipeline, report
from vibroacoustics.base.visible import DIRECTIONS, visible
from vibroacoustics.study.loading import load_study

NAME = "weights \u202egnp.eno\u2066"
SHOWN = "weights [U+202E]gnp.eno[U+2066]"


@pytest.fixture(scope="module")
def study_file(tmp_path_factory: pytest.TempPathFactory):
    text = TINY.read_text().replace("../../data", str(TINY.parents[2] / "data"))
    quoted = json.dumps(NAME)
    text = text.replace("[options.counterweight-half]", f"[options.{quoted}]")
    path = tmp_path_factory.mktemp("directions") / "study.toml"
    path.write_text(text)
    return path


def test_no_file_of_a_report_but_tables_has_one(study_file) -> None:
    """Tables for programs hold the name as it is; pictures are inside the page too."""
    files = report.render(pipeline.run(load_study(study_file), radiation=made_up_radiation))
    assert SHOWN in files["report.html"].decode()
    assert any(SHOWN in content.decode() for name, content in files.items() if ".svg" in name)
    for name, content in files.items():
        text = content.decode() if not name.endswith(".csv") else ""
        assert not {ord(letter) for letter in text} & set(DIRECTIONS), name
    assert NAME in files["scores.csv"].decode()


def test_lines_of_a_refusal_have_none(study_file, tmp_path) -> None:
    wrong = tmp_path / "study.toml"
    wrong.write_text(study_file.read_text().replace(json.dumps(NAME), json.dumps(NAME) + ".x"))
    outcome = command_here("check", wrong)
    assert outcome.returncode == 2
    assert SHOWN in outcome.stderr
    assert not {ord(letter) for letter in outcome.stderr} & set(DIRECTIONS)


def test_every_direction_has_its_code() -> None:
    """Of the bidirectional controls in Unicode's table, by the standard library."""
    import unicodedata

    controls = {
        code
        for code in range(0x3000)
        if unicodedata.bidirectional(chr(code))
        in {"LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI"}
    }
    assert controls <= set(DIRECTIONS)
    assert set(DIRECTIONS) - controls == {0x061C, 0x200E, 0x200F}  # marks, of letters' classes
    assert visible("a\u200fb") == "a[U+200F]b"


def test_control_characters_and_bytes_of_names_become_visible():
    text = "".join(map(chr, [*range(256), 0xD800, 0xDCFF, 0xDFFF]))
    shown = visible(f"μ {text}")
    assert shown.startswith("μ [U+0000]")
    assert {"[U+001B]", "[U+007F]", "[U+0085]", "[U+DCFF]"} <= set(re.findall(r"\[U\+\w+\]", shown))
    assert [each for each in shown if not each.isprintable()] == ["\t", "\n", "\r", "\xa0", "\xad"]
    shown.encode()
