"""`permit`: the file to begin with, its page and tables, refusals, a rule of another country."""

import csv
import json

import pytest
from support import command_here

FILE = """
[units.hp]
day_power_dba = 60.0
capacity_kw = 8.0
[windows.bedroom]
kind = "bwp"
area = "general-residential"
distance_m = 6.0
"""
RULE = '''
from typing import ClassVar

import vibroacoustics as va
from vibroacoustics.permits.rule import CalculationLine, PermitRule, PermitUnit


class Elsewhere(PermitRule):
    """L = L_W - 20 lg r, limit 50."""

    kind: ClassVar[str] = "elsewhere"
    title: ClassVar[str] = "Elsewhere"
    edition: ClassVar[str] = "Made up, 2026"

    def level_lines(self, unit: PermitUnit) -> list[CalculationLine]:
        return [CalculationLine("level", unit.day_power_dba - 10.0, "dB(A)")]

    @property
    def allowed_dba(self) -> float:
        return 50.0


va.register(Elsewhere)
'''


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("permit")
    assert command_here("new", "permit", "--out", folder).returncode == 0
    result = command_here("permit", folder / "permit.toml", "--out", folder / "out")
    assert result.returncode == 0, result.stderr
    return folder


def test_the_template_is_judged(folder):
    verdicts = {each["window"]: each for each in rows(folder / "out" / "verdicts.csv")}
    assert set(verdicts) == {"bedroom", "neighbour", "terrace"}
    assert float(verdicts["neighbour"]["level_dba"]) == pytest.approx(36.77, abs=0.01)


def test_the_calculation_can_be_repeated_from_the_page(folder):
    """58 + 10 lg(4/4π 6.5²) - 0 = 36.8."""
    page = (folder / "out" / "permit.html").read_text()
    lines = [
        each for each in rows(folder / "out" / "calculation.csv") if each["window"] == "neighbour"
    ]
    values = {each["text"].removeprefix("heat_pump: "): float(each["value"]) for each in lines}
    assert values["level that is compared, rounded"] == 36.8
    total = values["sound power level at full power, L_WA"] + values["10 lg(Q/4πr²)"]
    assert total - values["barrier, subtracted"] == pytest.approx(36.77, abs=0.01)
    for words in ("10 lg(Q/4πr²)", "36.77", "MCS 020 a) 1.1", "BEG since 1 January 2026"):
        assert words in page


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('kind = "bwp"', 'kind = "bpw"', "windows.bedroom.kind = bpw: unknown"),
        ('kind = "bwp"\n', "", "windows.bedroom.kind is missing"),
        ('area = "general-residential"\n', "", "give area"),
        ("distance_m = 6.0", "distance_m = -1", "windows.bedroom.distance_m = -1 m: out of range"),
        ("day_power_dba = 60.0", "day_power_dba = 600.0", "units.hp.day_power_dba = 600"),
        ("[windows.bedroom]", "[windows.bedroom.units.other]\ndistance_m = 3\n[windows.bedroom]",
         "windows.bedroom.units.other: no such unit; known are hp"),
        ("[units.hp]", "[units.hp]\ntone_adjustment_db = 2.0", "must be 0, 3 or 6"),
        ("[units.hp]", "[units.hp]\noctave_power_db = [1, 2]", "has 2 values: must be 8"),
        ('kind = "bwp"\narea = "general-residential"', 'kind = "mcs-020"', "at most 1.5 m³"),
        ("[units.hp]", "[unit.hp]", "must have tables [units.NAME] and [windows.NAME]"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_in_one_line(old, new, words, tmp_path):
    text = FILE.replace(old, new)
    if "m³" in words:
        text = text.replace("[units.hp]", "[units.hp]\nvolume_m3 = 2.0")
    (tmp_path / "p.toml").write_text(text)
    result = command_here("permit", tmp_path / "p.toml", "--out", tmp_path / "out")
    assert result.returncode == 2
    assert words in result.stderr.replace("\n", " "), result.stderr
    assert "p.toml" in result.stderr
    assert not (tmp_path / "out").exists()


def test_units_stand_at_their_own_distances(tmp_path):
    text = FILE + "[windows.bedroom.units.second]\ndistance_m = 12.0\n"
    text += "[units.second]\nday_power_dba = 60.0\n"
    (tmp_path / "p.toml").write_text(text)
    assert command_here("permit", tmp_path / "p.toml", "--out", tmp_path).returncode == 0
    values = [float(each["value"]) for each in rows(tmp_path / "calculation.csv")
              if "20 lg s" in each["text"] and each["unit"] == "dB"]  # fmt: skip
    assert values[1] - values[0] == pytest.approx(6.02, abs=0.01)


def test_a_rule_of_another_country_is_one_file(tmp_path):
    (tmp_path / "rule.py").write_text(RULE)
    text = FILE.replace('kind = "bwp"\narea = "general-residential"', 'kind = "elsewhere"')
    (tmp_path / "p.toml").write_text(text)
    result = command_here("permit", tmp_path / "p.toml", "--plugin", tmp_path / "rule.py", "--json")
    assert result.returncode == 0, result.stderr
    (verdict,) = json.loads(result.stdout)["tables"]["verdicts"]["spare_db"]
    assert verdict == 0.0
