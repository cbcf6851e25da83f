"""The tutorial's commands, typed in an empty folder, print what its page shows."""

import re
import shutil

import pytest
from run_tutorial import BLOCK, PAGE, alike, change_file, commands, follow, missing


@pytest.mark.long
@pytest.mark.skipif(shutil.which("chromium") is None, reason="prints a PDF with Chromium")
def test_page_shows_what_the_commands_print(tmp_path):
    differences, _ = follow(PAGE.read_text(encoding="utf-8"), tmp_path)
    assert not differences


def test_every_block_of_the_page_is_followed():
    page = PAGE.read_text(encoding="utf-8")
    blocks = list(BLOCK.finditer(page))
    assert len(blocks) == len(re.findall(r"(?m)^```(?:console|\{code-block)", page))
    typed = [
        command for block in blocks if block["console"] for command, _ in commands(block["console"])
    ]
    jobs = {command.split()[1] for command in typed if command.startswith("vibroacoustics")}
    assert jobs >= {"new", "check", "run", "report", "listen", "tones", "orders", "compare"}


def test_sentences_are_short():
    prose = re.sub(r"(?ms)^```.*?^```$", "", PAGE.read_text(encoding="utf-8"))
    sentences = re.split(r"(?<=[.:?])\s+|\n\n|^\d\. ", prose)
    assert not [words for words in sentences if len(words.split()) > 25]


@pytest.mark.parametrize(
    ("shown", "printed", "expected"),
    [
        ("level 58.7 dB", "level  58.8 dB", True),
        ("level 58.7 dB", "level 60.0 dB", False),
        ("60 % (0 % to 100 %)", "61 % (1 % to 99 %)", True),
        ("twin-oldham quieter", "twin-oldham louder", False),
        ("+2 dB", "-2 dB", False),
    ],
)
def test_lines_are_compared(shown, printed, expected):
    assert alike(shown, printed) is expected


def test_lines_in_another_order_are_missing():
    assert missing(["a 1", "…", "b 2"], ["a 1", "c", "b 2"]) == []
    assert missing(["b 2", "a 1"], ["a 1", "b 2"]) == ["a 1"]


def test_values_of_a_file_are_changed(tmp_path):
    file = tmp_path / "m.toml"
    file.write_text('name = "x"\n\n[a]\nm = 1\n\n[b]\nm = 2\n')
    change_file(file, "toml", 'name = "y"\n[b]\nm = 3\nn = 4\n[c]\nm = 5\n')
    assert file.read_text() == 'name = "y"\n\n[a]\nm = 1\n\n[b]\nm = 3\nn = 4\n\n\n[c]\nm = 5\n'
