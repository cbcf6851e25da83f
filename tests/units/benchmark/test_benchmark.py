"""The open benchmark: its scorer, our answers, and ten submissions that are wrong on purpose."""

import csv
import json
import math
import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

import pytest
from benchmark_answers.answers import ANSWERS, submission
from support import ROOT

BENCHMARK = ROOT / "data" / "benchmark"
CASES = BENCHMARK / "cases"
NAMES = sorted(ANSWERS)
Rows = list[dict[str, str]]


def scorer() -> ModuleType:
    """The file score.py, which no package holds."""
    spec = spec_from_file_location("score", BENCHMARK / "score.py")
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


SCORER = scorer()


def expected(case: str) -> Rows:
    with (CASES / case / "expected.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.fixture(scope="module")
def ours(tmp_path_factory) -> Rows:
    """Rows of our submission."""
    file = tmp_path_factory.mktemp("ours") / "submission.csv"
    file.write_bytes(submission(CASES))
    with file.open(encoding="utf-8", newline="") as text:
        return list(csv.DictReader(text))


def by_hand(rows: Rows, case: str) -> dict[str, bool]:
    """Verdict of each expected row as a test of this project would give it."""
    submitted = {row["key"]: row for row in rows if row["case"] == case}
    verdicts = {}
    for row in expected(case):
        answer = submitted.get(row["key"])
        try:
            value = float(answer["value"]) if answer else math.nan
        except ValueError:
            value = math.nan
        close = value == pytest.approx(float(row["value"]), rel=0.0, abs=float(row["tolerance"]))
        verdicts[row["key"]] = bool(answer and answer["unit"] == row["unit"] and close)
    return verdicts


def by_scorer(rows: Rows, case: str) -> dict[str, bool]:
    return {
        verdict.key: verdict.passed
        for verdict in SCORER.score(rows, [case])
        if verdict.case == case
    }


@pytest.mark.slow
@pytest.mark.parametrize("case", NAMES)
def test_scorer_and_tests_agree_that_our_answers_are_right(ours, case):
    verdicts = by_scorer(ours, case)
    assert verdicts == by_hand(ours, case)
    assert all(verdicts.values())
    assert len(verdicts) == len(expected(case)) == len([r for r in ours if r["case"] == case])


def changed(change: Callable[[str, float], str], where: str = "") -> Callable[[Rows], Rows]:
    """Change the values of the rows whose key or unit contains a word."""
    return lambda rows: [
        {**row, "value": change(row["unit"], float(row["value"]))}
        if where in row["key"] or row["unit"] == where
        else row
        for row in rows
    ]


def without_last(rows: Rows) -> Rows:
    return rows[:-1]


def shifted_orders(rows: Rows) -> Rows:
    """Each torque order has the value of the next."""
    values = {row["key"]: row["value"] for row in rows}
    shifts = {f"torque order {n}": f"torque order {n + 1}" for n in (1, 2, 3)}
    return [
        {**row, "value": values[row["key"].replace(old, shifts[old])]}
        if (old := row["key"].partition(": ")[2]) in shifts
        else row
        for row in rows
    ]


def moved_by_one_row(rows: Rows) -> Rows:
    """Values in an order of rows that is not that of the keys."""
    return [
        {**row, "value": after["value"]}
        for row, after in zip(rows, [*rows[1:], rows[0]], strict=True)
    ]


WRONG = {
    "oldham_force": (changed(lambda _, value: f"{-value}"), "the sign is reversed?"),
    "slider_link_invariants": (
        changed(lambda _, value: f"{2 * value}"),
        "a factor of 2 too large?",
    ),
    "point_and_ring_sources": (
        changed(lambda _, value: f"{value / math.sqrt(2.0)}"),
        "root mean square instead of peak?",
    ),
    "minicrank_torque": (
        changed(lambda _, value: f"{math.degrees(value)}", "rad"),
        "degrees instead of radians?",
    ),
    "counterweight_optimum": (
        lambda rows: [
            {**row, "unit": "g mm", "value": f"{1e6 * float(row['value'])}"}
            if row["unit"] == "kg m"
            else row
            for row in rows
        ],
        "unit = g mm: must be kg m",
    ),
    "changed_mounts": (without_last, "is missing"),
    "tone_audibility": (changed(lambda *_: "nan", "592.2"), "value = nan: must be a finite number"),
    "scroll_gas": (shifted_orders, "the value of 15 to 41.159 bar: torque order 2?"),
    "exact_room": (moved_by_one_row, "the value of microphone 2, third octave 100 Hz?"),
    "sound_power_example": (
        changed(lambda _, value: f"{value:.1f}".replace(".", ","), "octave 63 Hz"),
        "value = 90,5: must be a finite number",
    ),
}
"""What is done to right answers of each case, and what the scorer says of it."""


@pytest.mark.parametrize("case", NAMES)
def test_a_wrong_submission_is_seen(case):
    right = [{**row, "case": case} for row in expected(case)]
    change, words = WRONG[case]
    wrong = change(right)
    assert all(by_scorer(right, case).values())
    assert by_scorer(wrong, case) == by_hand(wrong, case)
    reasons = [v.reason for v in SCORER.score(wrong, [case]) if not v.passed]
    assert reasons
    assert any(words in reason for reason in reasons), reasons


@pytest.mark.parametrize("case", NAMES)
def test_the_order_of_rows_has_no_meaning(case):
    rows = [{**row, "case": case} for row in expected(case)]
    assert all(by_scorer(rows[::-1], case).values())


@pytest.mark.parametrize("case", NAMES)
@pytest.mark.parametrize(("share", "passes"), [(0.99, True), (1.01, False), (-1.01, False)])
def test_the_tolerance_is_a_limit(case, share, passes):
    rows = [{**row, "case": case} for row in expected(case)]
    for row in rows:
        row["value"] = f"{float(row['value']) + share * float(row['tolerance'])!r}"
    assert set(by_scorer(rows, case).values()) == {passes}


def test_rows_given_twice_without_key_or_case_fail():
    rows = [{**row, "case": "tone_audibility"} for row in expected("tone_audibility")]
    strange = [{**rows[0], "key": "audibility at 1 Hz"}, {**rows[0], "case": "no_case"}]
    verdicts = SCORER.score([*rows, rows[0], *strange], ["tone_audibility"])
    assert {verdict.reason for verdict in verdicts if not verdict.passed} == {
        "is given 2 times", "no such key is expected", "there is no such case",
    }  # fmt: skip


def run_alone(folder, *words, encoding="utf-8", timeout_s=30.0):
    """The scorer as users run it, without site packages."""
    command = [sys.executable, "-s", "-S", str(folder / "score.py"), *words]
    environment = os.environ | {"PYTHONIOENCODING": encoding}
    return subprocess.run(
        command, capture_output=True, text=True, check=False, encoding="utf-8", env=environment,
        timeout=timeout_s,
    )  # fmt: skip


def test_a_copied_folder_scores_csv_and_json(tmp_path):
    folder = tmp_path / "copied"
    shutil.copytree(BENCHMARK, folder, ignore=shutil.ignore_patterns("__pycache__"))
    rows = [{**row, "case": case} for case in NAMES for row in expected(case)]
    file = tmp_path / "all.json"
    file.write_text(json.dumps([{**row, "value": float(row["value"])} for row in rows]))
    done = run_alone(folder, str(file))
    assert done.returncode == 0
    assert done.stdout.endswith("10 of 10 cases passed\n")
    table = tmp_path / "two.csv"
    with table.open("w", newline="") as text:
        writer = csv.DictWriter(text, ["case", "key", "unit", "value"], extrasaction="ignore")
        writer.writeheader()
        writer.writerows([row for row in rows if row["case"] in NAMES[:2]])
    assert run_alone(folder, str(table), *NAMES[:2]).returncode == 0
    done = run_alone(folder, str(table), "--json")
    assert done.returncode == 1
    verdicts = json.loads(done.stdout)
    assert {each["case"] for each in verdicts if not each["passed"]} == set(NAMES[2:])


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("gone.csv", None, "gone.csv: cannot be read"),
        ("empty.csv", "", "empty.csv: must have at least one row"),
        ("short.csv", "case,key,value\na,b,1\n", "short.csv: row 1: unit = missing"),
        ("valueless.csv", "case,key,unit\na,b,N\n", "valueless.csv: row 1: value = missing"),
        ("broken.json", "[", "broken.json: cannot be read"),
        ("number.json", "[3]", "number.json: row 1: case = missing"),
        ("object.json", "{}", "object.json: must have at least one row"),
        ("nested.json", "[" * 100_000, "nested.json: cannot be read: lists or objects nest too"),
        ("closed.json", "[" * 100_000 + "]" * 100_000, "closed.json: cannot be read: lists or obj"),
        ("objects.json", '{"a":' * 90_000 + "1" + "}" * 90_000, "objects nest too deeply"),
        ("text.json", '[{"case": ["a"], "key": "b", "unit": "N", "value": 1}]', "case: must be te"),
        ("list.json", '[{"case": "a", "key": "b", "unit": "N", "value": [1]}]', "value: must be a"),
        ("digits.json", f"[{'9' * 5000}]", "digits.json: cannot be read"),
        ("large.csv", "case,key,unit,value\n" + " " * 1_000_000, "at most 1000000 bytes"),
        ("\x1b[31mred\x07.csv", "", r"\x1b[31mred\x07.csv: must have at least one row"),
        (
            "latin.csv",
            "case,key,unit,value\nµ".encode("latin-1"),
            "latin.csv: cannot be read: 'utf",
        ),
    ],
)
def test_a_bad_file_is_one_line(tmp_path, name, text, words):
    if text is not None:
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    done = run_alone(BENCHMARK, str(tmp_path / name))
    assert done.returncode == 2
    assert done.stdout == ""
    assert done.stderr.count("\n") == 1
    assert words in done.stderr


@pytest.mark.parametrize("kind", ["folder", "pipe", "device", "link to a pipe"])
def test_what_is_no_regular_file_is_refused(tmp_path, kind):
    """None of them is waited for."""
    file = tmp_path / "a.csv"
    if kind == "folder":
        file.mkdir()
    elif kind == "device":
        file = Path("/dev/zero")
    else:
        os.mkfifo(tmp_path / "pipe")
        file.symlink_to(tmp_path / "pipe")
        file = file if kind == "link to a pipe" else tmp_path / "pipe"
    done = run_alone(BENCHMARK, str(file))
    assert done.returncode == 2
    assert (done.stdout, done.stderr.count("\n")) == ("", 1)
    assert "is no regular file" in done.stderr or "cannot be read: Is a directory" in done.stderr


HOSTILE = "\x1b]0;title\x07\x1b[2J\u202e\r\n\x9b31m"


@pytest.mark.parametrize("field", ["case", "key", "unit", "value"])
@pytest.mark.parametrize("flag", [(), ("--json",)])
def test_no_control_character_reaches_the_terminal(tmp_path, field, flag):
    row = expected("oldham_force")[0]
    answer = {name: row.get(name, "oldham_force") for name in ("case", "key", "unit", "value")}
    answer[field] = f"{answer[field]}{HOSTILE}{'x' * 10_000}"
    (tmp_path / "a.json").write_text(json.dumps([answer]))
    done = run_alone(BENCHMARK, str(tmp_path / "a.json"), "oldham_force", *flag)
    assert done.returncode == 1
    assert r"x1b]0;title" in done.stdout or r"u001b]0;title" in done.stdout
    assert all(line.isprintable() for line in done.stdout.split("\n"))
    assert max(map(len, done.stdout.split("\n"))) < 1000


@pytest.mark.parametrize("value", ["9" * 4000, "1e999", "NaN", "-Infinity", "true", "null", '""'])
def test_a_value_that_is_no_finite_number_fails(tmp_path, value):
    row = {**expected("oldham_force")[0], "case": "oldham_force"}
    fields = json.dumps({name: row[name] for name in ("case", "key", "unit")})
    (tmp_path / "a.json").write_text(f'[{fields[:-1]}, "value": {value}}}]')
    done = run_alone(BENCHMARK, str(tmp_path / "a.json"), "oldham_force")
    assert done.returncode == 1
    assert "must be a finite number" in done.stdout
    assert done.stderr == ""


def test_many_unknown_cases_take_no_longer_than_their_lines(tmp_path):
    """60,000 names within 1 MB; the work is in proportion."""
    rows = "".join(f"c{number},,,\n" for number in range(60_000))
    (tmp_path / "a.csv").write_text(f"case,key,unit,value\n{rows}")
    done = run_alone(BENCHMARK, str(tmp_path / "a.csv"), "oldham_force", timeout_s=60.0)
    assert done.returncode == 1
    assert done.stdout.endswith("0 of 60001 cases passed\n")


def test_a_terminal_without_unicode(tmp_path):
    row = {**expected("oldham_force")[0], "case": "oldham_force", "value": "1"}
    (tmp_path / "a.json").write_text(json.dumps([row]))
    done = run_alone(BENCHMARK, str(tmp_path / "a.json"), "oldham_force", encoding="ascii")
    assert (done.returncode, done.stderr) == (1, "")
    assert r"\xb1" in done.stdout


def test_an_unknown_case_is_refused(tmp_path):
    (tmp_path / "a.csv").write_text("case,key,unit,value\na,b,N,1\n")
    done = run_alone(BENCHMARK, str(tmp_path / "a.csv"), "no_case")
    assert done.returncode == 2
    assert "case = no_case: must be one of changed_mounts" in done.stderr


@pytest.mark.parametrize("case", NAMES)
def test_a_case_says_where_its_numbers_come_from(case):
    tables = tomllib.loads((CASES / case / "case.toml").read_text(encoding="utf-8"))
    assert {"title", "question", "expected_from", "method", "tolerance", "inputs"} == set(tables)
    assert tables["expected_from"] in {"closed form", "printed", "second method"}
    assert all(set(entry) == {"name", "value", "unit", "source"} for entry in tables["inputs"])
    for row in expected(case):
        assert float(row["tolerance"]) > 0.0
        assert row["derivation"]


def test_there_is_an_answer_for_every_case():
    assert sorted(path.name for path in CASES.iterdir()) == NAMES == SCORER.case_names()


def test_expected_values_are_derived_again_without_our_code(tmp_path):
    folder = tmp_path / "copied"
    shutil.copytree(BENCHMARK, folder, ignore=shutil.ignore_patterns("__pycache__"))
    for file in folder.glob("cases/*/expected.csv"):
        file.unlink()
    command = [sys.executable, "-s", "-S", str(folder / "derive.py")]
    subprocess.run(command, check=True, capture_output=True, cwd=tmp_path)
    for name in NAMES:
        for file in ("expected.csv", "inputs.csv"):
            path = CASES / name / file
            if path.exists():
                assert (folder / "cases" / name / file).read_bytes() == path.read_bytes(), path


@pytest.mark.parametrize(
    ("case", "key", "printed", "digit"),
    [
        ("oldham_force", "printed radius, 3500 rpm: order 1 cosine", 65.9, 0.05),  # thesis 7.1
        ("oldham_force", "printed radius, 2900 rpm: order 1 cosine", 45.3, 0.05),
        ("minicrank_torque", "crank -10 um, scroll 0 um, 1500 rpm: largest torque", 100.0, 0.05),
        ("minicrank_torque", "crank -50 um, scroll 20 um, 1500 rpm: largest torque", 56.3, 0.05),
        ("scroll_gas", "15 to 41.159 bar: mean tangential force", 2959.0, 0.5),
        ("scroll_gas", "15 to 41.159 bar: torque order 1", 0.725, 0.0005),
        ("scroll_gas", "6.78 to 30.7 bar: mean torque", 7.61, 0.005),
        ("sound_power_example", "background correction K1", 0.5, 0.05),  # ISO 3744, 8.2.3
    ],
)
def test_expected_values_round_to_the_printed_ones(case, key, printed, digit):
    """Values of data/validation and of documents, half a unit of their last digit."""
    values = {row["key"]: float(row["value"]) for row in expected(case)}
    assert values[key] == pytest.approx(printed, abs=digit)
