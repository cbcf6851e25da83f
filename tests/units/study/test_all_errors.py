"""All errors of a file at once, in the words and units of the file."""

import copy
import re
import tomllib
from pathlib import Path

import pytest
from support import MACHINE_FILE, PIPELINES, ROOT, TINY, command_here

from vibroacoustics.base.errors import LONGEST_LINE, ParameterError
from vibroacoustics.base.units import si_key
from vibroacoustics.study.asked_keys import asked_key, meant_field, meant_key
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.study.toml_files import leaves
from vibroacoustics.study.wording import MOST_LINES

MACHINE_FILES = sorted((ROOT / "data" / "machines").glob("*.toml"))


def lines(load, path: Path) -> list[str]:
    """What is told, a line of limited length each."""
    with pytest.raises(ParameterError) as caught:
        load(path)
    told = str(caught.value).splitlines()
    assert all(str(path) in line for line in told if not line.startswith("and "))
    assert all(len(line) <= LONGEST_LINE for line in told)
    return told


def written(text: str, tmp_path: Path) -> Path:
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    return path


def with_line(text: str, old: str, new: str) -> str:
    assert text.count(old) == 1
    return text.replace(old, new)


def tiny(tmp_path: Path, old: str, new: str) -> Path:
    text = TINY.read_text(encoding="utf-8").replace("../../data", str(ROOT / "data"))
    return written(with_line(text, old, new), tmp_path)


def _toml(value) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    return "'''" + value + "'''" if isinstance(value, str) else repr(value).lower()


@pytest.mark.parametrize("example", MACHINE_FILES, ids=lambda path: path.stem)
def test_an_empty_machine_file_is_mended_in_three_rounds(example, tmp_path):
    """Each key that is asked for is taken from the example; its unit may be another."""
    beside = str(ROOT / "data" / "tables")
    content = tomllib.loads(example.read_text(encoding="utf-8").replace("../tables", beside))
    known = {(*keys[:-1], si_key(keys[-1])[0]): keys for keys in leaves(content)}
    given: dict[tuple[str, ...], str] = {}
    for _ in range(3):
        text = "\n".join(f"{'.'.join(keys)} = {value}" for keys, value in given.items())
        path = written(text, tmp_path)
        for line in lines(load_machine, path):
            if re.fullmatch(r"and \d+ more", line):
                continue
            word = line.removeprefix(f"{path}: ")
            if word.startswith("machine: kind is missing"):
                given[("kind",)] = _toml(content["kind"])
                continue
            keys = tuple(word.split(":")[0].split("."))
            source = known.get((*keys[:-1], si_key(keys[-1])[0]))
            assert source is not None or keys[0] in content, line
            value = content
            for key in source or keys:
                value = value[key]
            given[source or keys] = _toml(value)
        try:
            load_machine(
                written("\n".join(f"{'.'.join(k)} = {v}" for k, v in given.items()), tmp_path)
            )
        except ParameterError:
            continue
        return
    pytest.fail("not mended in three rounds")


def test_keys_are_asked_for_in_the_unit_of_an_example():
    used: dict[str, set[str]] = {}
    for file in MACHINE_FILES:
        for *_, key in leaves(tomllib.loads(file.read_text(encoding="utf-8"))):
            used.setdefault(si_key(key)[0], set()).add(key)
    wrong = {field: asked_key(field) for field in used if asked_key(field) not in used[field]}
    assert not wrong


def test_mistakes_of_all_sorts_come_at_once(tmp_path):
    text = MACHINE_FILE.read_text(encoding="utf-8")
    text = with_line(text, 'mass_kg = { value = 0.0727, source = "thesis 7.1" }', "mass_kg = -1.0")
    text = with_line(
        text,
        "lateral_stiffness_n_per_mm = { value = 20",
        "latteral_stiffness_n_per_mm = { value = 20",
    )
    text = text.replace("level_dba = ", "level = ")
    text = with_line(text, "[brake]", "[braek]")
    told = "\n".join(lines(load_machine, written(text, tmp_path)))
    for words in (
        'oldham.mass_kg = -1.0: needs a source: { value = -1.0, source = "…" }',
        "oldham.mass_kg = -1.0 kg: out of range; allowed above 0 to 100 kg",
        "mounts.latteral_stiffness_n_per_mm: unknown key, did you mean lateral_stiffness_n_per_mm",
        "overall_noise.level: unknown key, did you mean level_dba",
        "braek: unknown key, did you mean brake",
    ):
        assert words in told
    assert "missing" not in told
    assert len(told.splitlines()) == 5


def test_mistakes_of_options_and_receivers_come_at_once(tmp_path):
    receivers = (
        "[receivers.far]\nx_mm = 1e9\n[options.a]\nkind = 'b'\n[options.c]\nkind = 'none'\nd = 1\n"
    )
    path = tiny(tmp_path, "[operation]", f"{receivers}[operation]\nwarp = 9")
    told = lines(load_study, path)
    for key in ("options.a.kind = b", "options.c.d: unknown", "operation.warp: unknown",
                "receivers.far.x_mm = 1000000000.0 mm: out of range",
                "receivers.far.y_mm: is missing"):  # fmt: skip
        assert len([line for line in told if key in line]) == 1, key


def test_many_mistakes_are_counted(tmp_path):
    text = "".join(f"wrong{number} = 1\n" for number in range(1000))
    told = lines(load_machine, written("kind = 'oldham-scroll'\n" + text, tmp_path))
    assert len(told) == MOST_LINES + 1
    assert re.fullmatch(r"and \d+ more", told[-1])


def test_long_keys_give_short_lines(tmp_path):
    told = lines(load_machine, written(f"kind = 'oldham-scroll'\n{'k' * 5000} = 'x'", tmp_path))
    assert any("kkk …" in line and line.endswith("unknown key") for line in told)


@pytest.mark.parametrize(("table", "old"), [("options", "none"), ("receivers", "")])
def test_blank_names(tmp_path, table, old):
    new = {"options": "kind = 'none'", "receivers": "x_mm = 1\ny_mm = 1.0\nheight_mm = 1.0"}[table]
    path = tiny(tmp_path, "[operation]", f'[{table}."  "]\n{new}\n[operation]')
    assert any(f"{table}: a name is blank" in line for line in lines(load_study, path))


def test_the_command_line_prints_each(tmp_path):
    path = tiny(tmp_path, "[operation]", "[operation]\nwarp = 9\nweft = 8")
    outcome = command_here("run", path)
    assert outcome.returncode == 2
    first, second = outcome.stderr.splitlines()
    assert first.startswith("error: ")
    assert first.endswith("operation.warp: unknown key")
    assert second.startswith("error: ")
    assert second.endswith("operation.weft: unknown key")


@pytest.mark.parametrize(
    ("key", "field", "meant"),
    [
        ("orbit_radius", "orbit_radius_m", "orbit_radius_mm"),
        ("orbitt_radius_um", "orbit_radius_m", "orbit_radius_um"),
        ("mass_lbs", "mass_kg", "mass_kg"),
        ("moutns", "mounts", "mounts"),
    ],
)
def test_meant_key(key, field, meant):
    assert meant_field(key, [field, "pitch_m"]) == field
    assert meant_key(key, field) == meant


def test_nothing_is_meant():
    assert meant_field("warp", ["mass_kg", "height_m"]) is None
    assert meant_field("m" * 100_000, ["m" * 100]) is None


def test_errors_survive_a_process():
    error = copy.copy(ParameterError("a", "b"))  # as pickle does
    assert str(error) == "a\nb"


def test_the_thesis_still_loads():
    assert load_study(PIPELINES / "copeland_thesis.toml").title


def test_contradictions_between_tables_come_together(tmp_path):
    """Microphone, orders and a scale without values are refused in one go, a line each."""
    old = "near_field_spacing_mm = 35.0"
    path = tiny(tmp_path, old, f"{old}\n")
    text = with_line(path.read_text(), "x_mm = 1082.5", "x_mm = 2000.0")
    text = with_line(text, "maximum_order = 16", "maximum_order = 60")
    path.write_text(f"{text}risk = {{ weight = 1.0, best = 1.0, worst = 9.0 }}\n")
    told = lines(load_study, path)
    assert len(told) == 3
    assert any("catalogue_receiver = front_1m: stands" in line for line in told)
    assert any("radiation.maximum_frequency_hz = 1000 Hz: order 60" in line for line in told)
    assert any("risk" in line for line in told)
