"""The command line as a user meets it: exit codes, one-line errors, files, speed of --help."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest
from support import ROOT, TINY, assert_refused, command, command_here

SMALL = ROOT / "tests" / "studies" / "small.toml"
CSV_COLUMNS = (
    "option,speed_rpm,receiver,force_1x_n,force_2x_n,moment_1x_nm,foot_force_1x_n,level_1x_db,"
    "level_2x_db,level_1x_dba,level_modelled_dba,level_total_dba,change_1x_db,"
    "change_modelled_db,change_total_db"
)


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def here(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Commands of this process take the cache of the module, as those of their own do."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(cache))


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The tiny study at two speeds."""
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    file = tmp_path_factory.mktemp("study") / "study.toml"
    file.write_text(text.replace("[2900.0]", "[2900.0, 3500.0]"))
    return file


@pytest.fixture(scope="module")
def finished(cache: Path, study: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of one run of the study."""
    out = tmp_path_factory.mktemp("run") / "out"
    outcome = command("run", study, "--out", out, cache=cache)
    assert outcome.returncode == 0, outcome.stderr
    assert f"report: {out / 'report.html'}" in outcome.stdout
    assert outcome.stderr == ""  # no progress bar where stderr is no terminal
    return out


@pytest.mark.slow
def test_run_writes_everything(finished: Path) -> None:
    names = {path.name for path in finished.iterdir()}
    assert {
        "results.nc",
        "files.json",
        "report.html",
        "comparison.csv",
        "comparison.md",
        "scores.csv",
    } <= names
    assert not [name for name in names if name.startswith(".")]
    rows = (finished / "comparison.csv").read_text().splitlines()
    assert rows[0].startswith(CSV_COLUMNS)
    assert len(rows) - 1 == 2 * 2 * 1  # options, speeds, receivers


@pytest.mark.long
def test_radiation_alone(tmp_path: Path) -> None:
    study = ROOT / "tests" / "studies" / "field.toml"
    outcome = command("radiation", study, "--out", tmp_path / "out", cache=tmp_path / "cache")
    assert outcome.returncode == 0, outcome.stderr
    assert "front_1m" in outcome.stdout
    assert "iso3744-hemisphere-10, S = 6.28 m²" in outcome.stdout
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "transfer_vectors.nc",
        "transfer_vectors.html",
        "files.json",
        "transfer_vectors.svg",
        "map.svg",
        "directivity.svg",
    }


@pytest.mark.long
@pytest.mark.usefixtures("here")
def test_level_of_the_line_is_that_of_fine_grids(tmp_path: Path) -> None:
    """The level with cells of 12.5 mm is 44.2 dB (reports/showcase).

    Cells of 35 mm have an error of about (35/12.5)² x 0.02 dB for motion along x, and of 0.4 dB for
    rocking, which adds a tenth of the pressure.
    """
    command_here("run", SMALL, "--out", tmp_path).check_returncode()
    with (tmp_path / "comparison.csv").open() as file:
        rows = list(csv.DictReader(file))
    line = {
        (row["option"], row["speed_rpm"], row["receiver"]): float(row["level_1x_db"])
        for row in rows
    }
    assert line["none", "2900", "front_1m"] == pytest.approx(44.2, abs=0.3)
    assert line["none", "3500", "front_1m"] == pytest.approx(48.4, abs=0.3)


@pytest.mark.slow
@pytest.mark.usefixtures("here")
def test_second_run_takes_the_cache(
    finished: Path, study: Path, cache: Path, tmp_path: Path
) -> None:
    again = command_here("run", study, "--out", tmp_path)
    assert again.returncode == 0, again.stderr
    first = (finished / "comparison.csv").read_bytes()
    assert (tmp_path / "comparison.csv").read_bytes() == first
    assert len(list((cache / "vibroacoustics").glob("transfer-vectors-*.nc"))) == 1


@pytest.mark.slow
def test_report_is_rebuilt_without_kwave(finished: Path, cache: Path, tmp_path: Path) -> None:
    blocker = (
        "import sys; sys.modules['kwave'] = None; sys.argv[0] = 'vibroacoustics';"
        "from vibroacoustics.commands.cli import main; main()"
    )
    outcome = subprocess.run(
        [sys.executable, "-c", blocker, "report", finished / "results.nc", "--out", tmp_path],
        capture_output=True,
        text=True,
        check=False,
    )
    assert outcome.returncode == 0, outcome.stderr
    assert (tmp_path / "report.html").read_bytes() == (finished / "report.html").read_bytes()


@pytest.mark.slow
def test_score_prints_the_ranking(finished: Path, tmp_path: Path) -> None:
    stored = command_here("score", finished / "results.nc", "--out", tmp_path)
    assert stored.returncode == 0, stored.stderr
    assert stored.stdout.splitlines()[1].split()[0] == "1"
    assert (tmp_path / "scores.csv").read_bytes() == (finished / "scores.csv").read_bytes()


@pytest.mark.slow
def test_damaged_results_are_refused(finished: Path, tmp_path: Path) -> None:
    content = bytearray((finished / "results.nc").read_bytes())
    content[len(content) // 2] ^= 0xFF
    (tmp_path / "results.nc").write_bytes(content)
    assert_refused(command_here("report", tmp_path / "results.nc"), "hash")
    assert not (tmp_path / "report.html").exists()


def test_schema_writes_what_is_shipped(tmp_path: Path) -> None:
    outcome = command_here("schema", "--out", tmp_path / "schemas")
    assert outcome.returncode == 0, outcome.stderr
    for name in ("study.json", "machine.json"):
        assert f"#:schema {tmp_path / 'schemas' / name}\n" in outcome.stdout
        shipped = ROOT / "data" / "schemas" / name
        assert (tmp_path / "schemas" / name).read_bytes() == shipped.read_bytes()


@pytest.mark.usefixtures("here")
def test_doctor(cache: Path) -> None:
    outcome = command_here("doctor")
    assert outcome.returncode == 0, outcome.stderr
    for word in ("vibroacoustics", "memory", "fft", "k-wave: solver loads", "cache", str(cache)):
        assert word in outcome.stdout


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("maximum_order = 16", "maximum_ordr = 16", ["operation.maximum_ordr", "unknown key"]),
        ("maximum_order = 16", 'maximum_order = "16"', ["operation.maximum_order = '16'"]),
        ("maximum_order = 16", "maximum_order = nan", ["operation.maximum_order = nan"]),
        ("maximum_order = 16", "speed_rpm = [0.0, 2900.0]", ["speed_rpm = 0 rpm", "60"]),
        (
            "[operation]",
            '[machine.override.oldham]\nmass_kg = { value = -1.0, source = "test" }\n[operation]',
            ["oldham.mass_kg = -1.0 kg", "allowed above 0"],
        ),
        (
            "[operation]",
            "[machine.override.kinematics]\n"
            'orbit_radius_m = { value = 6.75, source = "test" }\n[operation]',
            ["orbit_radius_m = 6.75 m", "allowed from 0.0001 to 0.05 m"],
        ),
        (
            "[operation]",
            '[options.magic]\nkind = "magic"\n[operation]',
            ["options.magic.kind = magic: unknown", "spring-mass,"],
        ),
        (
            "[operation]",
            '[options.spring-mass]\nstiffness_n_per_mm = { value = 9.0, source = "test" }\n'
            "[operation]",
            ["options.spring-mass: stiffness_n_per_mm = 9 N/mm", "allowed below 4.883"],
        ),
        (
            "near_field_spacing_mm = 35.0",
            "[receivers.far]\nx_mm = 19000.0\ny_mm = 19000.0\nheight_mm = 19000.0\n"
            '[radiation]\nkwave_receivers = "all"\n',
            None,
        ),
    ],
)
def test_bad_studies(old: str, new: str, words: list[str] | None, tmp_path: Path) -> None:
    """One clear line, exit code 2, no traceback, nothing written."""
    text = SMALL.read_text().replace("../../pipelines", str(ROOT / "pipelines"))
    if words is None:  # a room of 19 m at the finest spacing: larger than any memory
        text = text.replace("[radiation]\n", "").replace("room_spacing_mm = 60.0", "")
        new += "room_spacing_mm = 5.0\n"
        words = ["room_spacing_mm", "GiB"]
    study = tmp_path / "bad.toml"
    study.write_text(text.replace(old, new))
    outcome = command_here("run", study, "--out", tmp_path / "out")
    assert_refused(outcome, "bad.toml", *words)
    assert not (tmp_path / "out").exists()


def test_output_that_cannot_be_written(tmp_path: Path) -> None:
    """Refused before anything is computed."""
    (tmp_path / "file").write_text("")
    outcome = command_here("run", SMALL, "--out", tmp_path / "file" / "out")
    assert_refused(outcome, "file/out", "cannot be written")


@pytest.mark.slow
def test_cache_file_is_no_result(finished: Path, cache: Path) -> None:
    """A file of the cache has a hash and is netCDF, but no run."""
    (cached,) = (cache / "vibroacoustics").glob("transfer-vectors-*.nc")
    for name in ("report", "score"):
        assert_refused(command_here(name, cached), cached.name, "schema_version")


def test_missing_study(cache: Path, tmp_path: Path) -> None:
    """In a process of its own; the other refusals are the same `main` in this one."""
    assert_refused(command("run", tmp_path / "none.toml", cache=cache), "none.toml", "no such file")


def test_help_is_fast(cache: Path) -> None:
    """Not a timing test: `--help` must not load what takes the time."""
    heavy = "{'numpy', 'xarray', 'scipy', 'matplotlib', 'kwave', 'pydantic'}"
    script = (
        "import sys; sys.argv = ['vibroacoustics', '--help']\n"
        "from vibroacoustics.commands.cli import main\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        f"loaded = {heavy} & set(sys.modules)\n"
        "sys.exit(f'loaded {loaded}' if loaded else 0)"
    )
    outcome = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    assert outcome.returncode == 0, outcome.stderr
