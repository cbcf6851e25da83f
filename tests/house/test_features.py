"""What README, docs and changelog name is reached by a command or a public name."""

import inspect
import io
import pydoc
import re
import subprocess
import sys
from contextlib import redirect_stdout

import pytest
import typer
from public_names import faults_of_page, faults_of_script
from support import ROOT

import vibroacoustics as va
from vibroacoustics.commands import cli

FEATURES = {
    "run of a study": "command run",
    "run in Python": "va.run",
    "several machines, in Python": "va.run_machines",
    "results of several machines": "va.open_machines",
    "values of a study changed": "va.Study.replace",
    "study from a file": "va.load_study",
    "sweep of designs": "command sweep",
    "sweep in Python": "va.sweep",
    "best designs": "command optimise",
    "best designs, in Python": "va.optimise",
    "counterweights balanced": "va.balance",
    "what balancing finds": "va.Balanced",
    "machine on the bench balanced": "command balance",
    "machine on the bench balanced, in Python": "va.balance_runs",
    "what balancing on the bench finds": "va.BalancedRuns",
    "weights to add": "va.PlacedWeight",
    "unit judged by authorities' rules": "command permit",
    "unit judged in Python": "va.judge_permit",
    "what a rule says": "va.PermitVerdict",
    "unit to be judged": "va.PermitUnit",
    "rule of one's own": "va.PermitRule",
    "line of its calculation": "va.CalculationLine",
    "radiation alone": "command radiation",
    "radiation alone, in Python": "va.radiate",
    "measured transfer vectors": "va.given_radiation",
    "report again": "command report",
    "report in Python": "va.write_report",
    "data sheet": "command datasheet",
    "data sheet in Python": "va.data_sheet",
    "data sheet written from Python": "va.write_data_sheet",
    "what a data sheet holds": "va.DataSheet",
    "ranking again": "command score",
    "ranking in Python": "va.score",
    "versions, memory, cache": "command doctor",
    "cache listed and cleared": "command cache",
    "orders of a recording": "command orders",
    "orders in Python": "va.analyse_orders",
    "order map": "va.plot.order_map",
    "order cuts": "va.orders.order_cut",
    "orders over the speed": "va.plot.orders_over_speed",
    "angular resampling": "va.orders.angular_resample",
    "synchronous averages": "va.orders.time_synchronous_average",
    "synchronous envelopes": "va.orders.synchronous_demodulation",
    "Vold-Kalman tracking": "command track",
    "Vold-Kalman tracking in Python": "va.track_orders",
    "tracked orders drawn": "va.plot.tracked_orders",
    "speed-frequency map": "command map",
    "speed-frequency map in Python": "va.speed_frequency_map",
    "speed-frequency map drawn": "va.plot.speed_frequency_map",
    "levels over the speed": "va.plot.levels_over_speed",
    "sources over the speed": "va.plot.source_levels_over_speed",
    "Campbell diagram": "va.plot.campbell",
    "tacho": "va.SpeedChannel",
    "speed without a tacho": "va.TacholessSpeed",
    "gears": "va.orders.CrankMotion.geared",
    "filter bank": "va.levels.band_signal",
    "options to listen to": "command listen",
    "options to listen to, in Python": "va.listen",
    "impulse responses of a room": "command impulse-responses",
    "impulse responses of a room, in Python": "va.impulse_responses",
    "what a sound is made of": "va.sound.ingredients",
    "sound in a room": "va.rooms.room_transfer",
    "materials of rooms": "va.rooms.read_library",
    "tones of a recording": "command tones",
    "tones, in Python": "va.sound.tones",
    "loudness and sharpness": "va.sound.loudness_of",
    "Fast and Slow": "va.levels.recorded_levels",
    "third octaves": "va.levels.band_levels",
    "recordings read": "va.read_recording",
    "recordings read in blocks": "va.open_recording",
    "simulated signals labelled": "va.label_recording",
    "recordings exported": "command export",
    "recordings exported in Python": "va.export_recording",
    "measured modes": "va.read_modes",
    "functions of frequency read": "va.read_functions",
    "functions of frequency written": "va.export_functions",
    "sound power of recorded microphones": "command sound-power",
    "sound power of recorded microphones, in Python": "va.sound_power",
    "hemisphere and box of microphones": "va.MeasurementSurface",
    "absorption area of a room": "va.levels.reverberant_absorption_area_m2",
    "an option played in a recording": "command replay",
    "an option played in a recording, in Python": "va.replay",
    "change of mounts from measurements": "command predict",
    "change of mounts from measurements, in Python": "va.predict",
    "faults of hammer tests": "command check-functions",
    "records of hammer tests": "command hammer",
    "records of hammer tests, in Python": "va.hammer_test",
    "blocked forces": "command blocked-forces",
    "blocked forces, in Python": "va.blocked_forces",
    "blocked forces, for arrays": "va.inverted_forces",
    "blocked forces drawn": "va.plot.blocked_force",
    "on-board validation drawn": "va.plot.blocked_validation",
    "change of mounts, for arrays": "va.changed_response",
    "levels before and after a change drawn": "va.plot.predicted_levels",
    "comparison of orders": "command compare",
    "comparison of orders in Python": "va.compare",
    "comparison of orders drawn": "va.plot.compared_orders",
    "differences of orders drawn": "va.plot.order_differences",
    "runs and specimens averaged": "va.mean_of_runs",
    "many recordings with common settings": "va.analyse_campaign",
    "common settings from a file": "va.load_campaign",
    "common settings in Python": "va.Campaign",
    "settings of one of many recordings": "va.CampaignRun",
    "limits of orders": "va.check_limits",
    "limits from a file": "va.read_limits",
    "limits made in Python": "va.Limit",
    "limits of all figures from a file": "va.read_figure_limits",
    "limits of all figures made in Python": "va.FigureLimit",
    "inner curves, critical speed": "command curves",
    "inner curves, critical speed, in Python": "va.curves",
    "inner curves drawn": "va.plot.curves",
    "machine from a file": "va.load_machine",
    "machine and study to begin with": "command new",
    "errors of a file, cost of a run": "command check",
    "schemas for editors": "command schema",
    "forces drawn": "va.plot.force_over_revolution",
    "directivity drawn": "va.plot.directivity",
    "level map drawn": "va.plot.line_map",
    "level over a room drawn": "va.plot.room_map",
    "both methods of a room drawn": "va.plot.room_seam",
    "stopping drawn": "va.plot.stopping",
    "sources drawn": "va.plot.source_third_octaves",
    "paths of sound drawn": "va.plot.path_shares",
    "scores drawn": "va.plot.scores",
    "probability of ranks drawn": "va.plot.rank_acceptability",
    "balancer of one's own": "va.Option",
    "machine of one's own": "va.Machine",
    "source of one's own": "va.Source",
    "criterion of one's own": "va.Criterion",
    "section of one's own": "va.Section",
    "blocks of a section": "va.blocks.Table",
    "column of one's own": "va.Column",
    "variable of one's own": "va.Variable",
    "unit of one's own": "va.Unit",
    "reader of one's own": "va.Reader",
    "stage of one's own": "va.Stage",
    "data file of a plug-in": "va.FileTable",
    "columns of a CSV file": "va.read_columns",
    "what a machine offers to options": "va.Capability",
    "axes of a mechanism": "va.CrankFrame",
    "speed over a revolution": "va.Rotation",
    "insertion loss of an option": "va.InsertionLoss",
    "force on an Oldham ring": "va.RingForce",
    "further Oldham ring": "va.FurtherRing",
    "tables of a machine of one's own": "va.Parameters",
    "designs judged, in Python": "va.Problem.evaluate",
    "plug-in in a notebook": "va.load_plugin",
}
BUILT = {"_build", "generated", "examples"}
PAGES = [
    ROOT / "README.md",
    *(page for page in sorted((ROOT / "docs").rglob("*.md"))
      if BUILT.isdisjoint(page.relative_to(ROOT).parts)),
]  # fmt: skip
SCRIPTS = [
    *(file for folder in ("gallery", "figures") for file in (ROOT / "docs" / folder).glob("*.py")),
    *(file for file in (ROOT / "tests" / "third_party").glob("*.py") if file.stem[:5] != "test_"),
]
COMMANDS = set(typer.main.get_command(cli.app).commands)


@pytest.mark.parametrize("feature", FEATURES)
def test_feature_is_reached(feature):
    way = FEATURES[feature]
    if way.startswith("command "):
        assert way.removeprefix("command ") in COMMANDS
        return
    names = way.split(".")[1:]
    assert names[0] in va.__all__, names[0]
    thing = va
    for name in names:
        thing = getattr(thing, name)
    assert (inspect.getdoc(thing) or "").strip()


def test_every_command_is_a_feature():
    assert {way.removeprefix("command ") for way in FEATURES.values()} >= COMMANDS


def test_first_steps_name_every_command():
    text = (ROOT / "docs" / "start.md").read_text(encoding="utf-8")
    assert not [name for name in COMMANDS if f"| `vibroacoustics {name}" not in text]


def test_pages_name_nothing_private():
    found = {str(page.relative_to(ROOT)): set(faults_of_page(_text(page))) for page in PAGES}
    assert not {page: names for page, names in found.items() if names}


def test_scripts_and_plugins_name_nothing_private():
    found = {str(file.relative_to(ROOT)): set(faults_of_script(_text(file))) for file in SCRIPTS}
    assert not {file: names for file, names in found.items() if names}


def _text(path):
    return path.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("```python\nimport vibroacoustics.report\n```\n", "vibroacoustics.report"),
        ("```python\nfrom vibroacoustics.report.tables import Table\n```\n",
         "vibroacoustics.report.tables"),
        ("```python\nfrom vibroacoustics import run, report\n```\n", "report"),
        ("```python\nimport vibroacoustics as va\nva.report\n```\n", "vibroacoustics.report"),
        ("```python\nspace = Space(study)\n```\n", "Space"),
        ("```python\nangle = uniform_crank_angle(4)\n```\n", "uniform_crank_angle"),
        ("a table gives `AngularPlan`", "AngularPlan"),
        ("a table `Annotated[float, HeldRange]`", "HeldRange"),
        ("see `mechanics.capabilities.UPRIGHT`", "mechanics.capabilities.UPRIGHT"),
        ("height is `UPRIGHT`", "UPRIGHT"),
        ("made by `axes_of(frame)`", "axes_of(frame)"),
        ("made by `uniform_crank_angle`", "uniform_crank_angle"),
    ],
)  # fmt: skip
def test_private_names_are_seen(text, fault):
    assert set(faults_of_page(text)) == {fault}


@pytest.mark.parametrize(
    "text",
    [
        "```python\nfrom vibroacoustics import Section, blocks\n```\n",
        "```python\nimport vibroacoustics as va\nva.blocks.Table\n```\n",
        "```python\ndef axes_of(frame): ...\naxes_of(1)\n```\n",
        "the key `kind`, the curve `pocket_pressure`, the file `report.html`, `--point X,HEIGHT`",
        "a `Section`, `va.Section`, `Section.title`, `Study.replace(...)`, `read_modes(path)`",
        "its source is [`axes_of`](../vibroacoustics/mechanics/moving_parts.py)",
        "```\nvibroacoustics report UPRIGHT\n```\n",
    ],
)
def test_public_names_and_words_of_files_are_free(text):
    assert not list(faults_of_page(text))


def test_dir_and_help_show_the_public_names():
    assert dir(va) == sorted(va.__all__)
    assert dir(va.plot) == sorted(va.plot.__all__)
    shown = io.StringIO()
    with redirect_stdout(shown):
        pydoc.doc(va, output=shown)
    text = re.sub("\b.", "", shown.getvalue())
    for name in ("track_orders", "load_study", "Option"):
        assert name in text
    missing = [name for name in va.__all__ if f"`{name}" not in (va.__doc__ or "")]
    assert not missing, "not in the docstring of the package"


def test_every_figure_returns_a_figure_and_says_what_it_needs():
    for name in va.plot.__all__:
        thing = getattr(va.plot, name)
        assert inspect.signature(thing).return_annotation == "matplotlib.figure.Figure", name
        assert "needs `" in thing.__doc__, name
        assert f"`{name}`" in va.plot.__doc__, name


def test_listing_the_names_loads_nothing():
    code = (
        "import sys, vibroacoustics; dir(vibroacoustics); "
        "print([m for m in ('numpy', 'xarray', 'kwave') if m in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"
