"""Plug-ins: sections, columns, variables, units, readers: by file and as installed packages."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
from support import ROOT, TINY, assert_refused, command_here, tiny_run
from test_third_party import THIRD_PARTY, command, forgetful_command, plugins

from vibroacoustics.results.storage import open_results, write_results

ENTRY_POINTS = """[vibroacoustics.sections]
floor_force = floor_force:SECTION
vibration_severity = vibration_severity:SECTION
[vibroacoustics.stages]
vibration-severity = vibration_severity:VibrationSeverity
[vibroacoustics.columns]
force_3x_n = third_force:COLUMN
[vibroacoustics.variables]
floor_force = floor_force:FLOOR_FORCE
vibration_severity = vibration_severity:SEVERITY
[vibroacoustics.coordinates]
side = floor_force:SIDE
[vibroacoustics.units]
inch = inches:INCH
[vibroacoustics.readers]
plain-bytes = plain_bytes:READER
process = reading_process:READER
"""


MODULES = (
    "floor_force", "third_force", "inches", "plain_bytes", "reading_process", "vibration_severity",
)  # fmt: skip


@pytest.fixture(scope="module")
def installed(tmp_path_factory) -> Path:
    """A folder of installed packages: the files, which register nothing, and entry points."""
    folder = tmp_path_factory.mktemp("site")
    for name in MODULES:
        text = (THIRD_PARTY / f"{name}.py").read_text()
        plain = re.sub(r"(?m)^@?vibroacoustics\.register.*\n", "", text)
        (folder / f"{name}.py").write_text(plain)
    information = folder / "third_party-1.2.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: third_party\nVersion: 1.2\n"
    )
    (information / "entry_points.txt").write_text(ENTRY_POINTS)
    return folder


@pytest.fixture(params=["installed", pytest.param("by file", marks=pytest.mark.long)])
def third_party(request, installed):
    """The command line of this process with the plug-ins."""

    def run(*words: object, names: tuple[str, ...]):
        if request.param == "installed":
            return forgetful_command(*words, path=installed)
        return forgetful_command(*words, *plugins(*names))

    return run


@pytest.fixture(scope="module")
def results_file(tmp_path_factory) -> Path:
    return write_results(tiny_run(), tmp_path_factory.mktemp("results") / "results.nc")


def test_section_column_and_variable_are_shown(third_party, results_file, tmp_path):
    names = ("floor_force", "third_force")
    outcome = third_party("report", results_file, "--out", tmp_path / "out", names=names)
    assert outcome.returncode == 0, outcome.stderr
    page = (tmp_path / "out" / "comparison.md").read_text()
    assert "is missing:" not in page
    assert "is omitted:" not in page
    assert "What the floor gets" in page
    assert "largest force of a side" in page
    assert "Force 3×, N" in page
    csv = (tmp_path / "out" / "comparison.csv").read_text().splitlines()
    assert csv[0].endswith(",force_3x_n")


def test_stage_gives_its_variable_and_section(third_party, tmp_path):
    """Severity of the worst axis by hand; the report is made again without the plug-in."""
    out, study = tmp_path / "out", tmp_path / "study.toml"
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    study.write_text(text.replace("[radiation]\n", '[radiation]\nroom_solver = "closed-form"\n'))
    outcome = third_party("run", study, "--out", out, names=("vibration_severity",))
    assert outcome.returncode == 0, outcome.stderr
    results = open_results(out / "results.nc")
    severity = results["vibration_severity"].sel(option="none").values
    along = results["velocity_order"].sel(option="none", dof=["tx", "ty", "tz"]).sum("source")
    orders = along.transpose("speed", "dof", "order").values
    for row, speed in enumerate(results["speed"].values):
        hertz = results["order"].values * speed / 60.0
        kept = orders[row][:, (hertz >= 10.0) & (hertz <= 1000.0)]
        worst = np.sqrt(np.sum(np.abs(kept) ** 2, axis=1) / 2.0).max()
        assert severity[row] == pytest.approx(1e3 * worst, rel=1e-12)
    again = command_here("report", out / "results.nc", "--out", tmp_path / "again")
    assert again.returncode == 0, again.stderr
    for page in (out, tmp_path / "again"):
        assert "## Vibration severity" in (page / "comparison.md").read_text()


def test_unit_is_read_and_told(third_party, tmp_path):
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    option = """[options.weight]
kind = "counterweight"
mass_g = { value = 10.0, source = "a test" }
radius_inch = { value = 400.0, source = "a test" }
angle_deg = { value = 0.0, source = "a test" }
height_mm = { value = 0.0, source = "a test" }

[receivers."""
    study = tmp_path / "study.toml"
    study.write_text(text.replace("[receivers.", option, 1))
    without = command_here("run", study)
    assert_refused(without, "options.weight.radius_inch: unknown key")
    outcome = third_party("run", study, names=("inches",))
    assert_refused(
        outcome, "options.weight.radius_inch = 400.0 in: out of range", "above 0 to 19.685 in"
    )


ANALYSIS = ("--rpm", "3000", "--maximum-order", "5")


def plain_recording(folder: Path) -> Path:
    """Sines of 50 Hz of 0.5 V at the front and 0.25 V at the rear, in the plug-in's format."""
    sine = 64.0 * np.sin(2.0 * np.pi * 50.0 * np.arange(4000) / 1000.0 + 0.1)
    stored = np.round(np.stack([sine, 0.5 * sine], axis=1)).astype(np.int8)
    (folder / "sine.plain").write_bytes(stored.tobytes())
    return folder / "sine.plain"


def test_reader_gives_the_requested_channels(installed, tmp_path):
    """Within half a step of 1/128 V on a peak of 0.25 V: 1.6 %.

    In processes of their own, which find the installed package each for itself.
    """
    words = ("orders", plain_recording(tmp_path), *ANALYSIS, "--out", tmp_path / "out")
    assert_refused(command_here(*words), "format '.plain' is unknown; known are .csv")
    outcome = command(*words, "--channels", "rear", path=installed)
    assert outcome.returncode == 0, outcome.stderr
    results = open_results(tmp_path / "out" / "orders.nc")
    assert results["channel"].values.tolist() == ["rear"]
    first = results["channel_order_rms"].sel(order=1).item()
    assert first == pytest.approx(0.25 / np.sqrt(2.0), rel=0.016)
    origin = json.loads(results.attrs["plugins"])["reader plain-bytes"]
    assert origin["file"] == "plain_bytes.py"


def test_missing_package_of_a_reader_is_named(third_party, tmp_path):
    file = tmp_path / "bad.process"
    file.write_bytes(bytes(100))
    outcome = third_party("orders", file, "--rpm", "3000", names=("reading_process",))
    assert_refused(outcome, "needs no_such_module: pip install process-of-pip")


@pytest.mark.long
def test_doctor_lists_an_installed_reader(installed, tmp_path):
    outcome = command("doctor", path=installed)
    needs = "recordings: reading process: needs process-of-pip: pip install process-of-pip"
    assert needs in outcome.stdout
