"""Broken plug-ins of every sort: each is one line with file and line of code, none a traceback."""

import re
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from pathlib import Path
from typing import NamedTuple
from unittest.mock import patch

import numpy as np
import pytest
import xarray as xr
from support import ROOT, TINY, assert_refused, command_here, made_up_radiation
from test_third_party import THIRD_PARTY, rotor_study

from vibroacoustics import pipeline, report
from vibroacoustics.base import registry
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.fault import MOST_WORDS
from vibroacoustics.base.plugin_file import load_plugin
from vibroacoustics.machine.source import SOURCES
from vibroacoustics.recordings.child import answer
from vibroacoustics.recordings.recorded import Request
from vibroacoustics.results import criterion_values
from vibroacoustics.results.storage import open_results
from vibroacoustics.study.loading import load_study
from vibroacoustics.uncertainty.every_sample import in_every_sample

IMPORTS = "import sys\nimport numpy as np\nimport vibroacoustics as va\n"
LONG = "raise RuntimeError('x' * 5000)"
NO_MEMORY = "raise MemoryError('1 TiB')"
INTERRUPT = "raise KeyboardInterrupt"


class Broken(NamedTuple):
    """One plug-in: what it is, its method's body, and what the line says of it."""

    noun: str
    name: str
    body: str
    words: str


OPTION = """@va.register
class Odd(va.Option):
    kind = "{name}"
    def added(self, machine, revolution):
        good = va.Added((), {{"added_mass_kg": 0.0}})
        {body}
"""
CRITERION = """@va.register
class Odd(va.Criterion):
    name = "{name}"
    def value(self, results):
        force = results["force_amplitude"].sel(order=1).max("speed")
        {body}
"""
COLUMN = """def values(results):
    force = results["force_amplitude"].sel(order=1)
    {body}
va.register(va.Column("{name}", values, "Odd"))
"""
SECTION = """def blocks(results):
    {body}
va.register(va.Section("{name}", "Odd", blocks))
"""
STAGE = """va.register(va.Variable("{name}", ("speed", "option"), "N", "odd"))
@va.register
class Odd(va.Stage):
    name = "{name}"
    reads = ("force_amplitude",)
    gives = ("{name}",)
    def run(self, chain):
        force = chain.results["force_amplitude"].sel(order=1)
        coords = {{dim: force[dim].values for dim in ("speed", "option")}}
        {body}
"""
CODES = {
    "kind of option": OPTION,
    "criterion": CRITERION,
    "column": COLUMN,
    "section": SECTION,
    "stage": STAGE,
}
STAMPED = 'return va.Given(va.stamp("{}", {}, coords).to_dataset())'
LEFT_OUT = (
    Broken("kind of option", "raising", "1 / 0", "ZeroDivisionError: division by zero"),
    Broken("kind of option", "nothing", "return None", "added returns None, must be Added"),
    Broken("kind of option", "leaving", "sys.exit(7)", "SystemExit: 7"),
    Broken("kind of option", "long-words", LONG, "RuntimeError: xxx"),
    Broken("kind of option", "memory", NO_MEMORY, "MemoryError: 1 TiB"),
    Broken("kind of option", "interrupted", INTERRUPT, "KeyboardInterrupt"),
    Broken(
        "kind of option", "text", 'return va.Added((), {"added_mass_kg": "heavy"})',
        "added returns a str in figures, must be float",
    ),
    Broken(
        "kind of option", "no-number", 'return va.Added((), {"added_mass_kg": np.nan})',
        "ValueError: figures: need a finite added_mass_kg",
    ),
    Broken(
        "kind of option", "no-path",
        'return va.Added((va.MovingPart("a", 1.0, np.full((3, 9), np.nan)),), good.figures)',
        "added returns numbers that are not finite in position_m",
    ),
    Broken(
        "kind of option", "short",
        'return va.Added((va.MovingPart("a", 1.0, np.zeros((3, 9))),), good.figures)',
        "ValueError: a: shape (3, 9), must be (3,",
    ),
    Broken("criterion", "raising_n", "raise KeyError('loudness')", "KeyError: 'loudness'"),
    Broken("criterion", "nothing_n", "return None", "value returns None, must be DataArray"),
    Broken("criterion", "nan_n", "return force * np.nan", "has no finite value for the option"),
    Broken("criterion", "text_n", "return force.astype(str)", "TypeError: ufunc 'isfinite'"),
    Broken("criterion", "wide_n", "return results['force_amplitude']", "has dims ("),
    Broken("criterion", "leaving_n", "sys.exit()", "SystemExit"),
    Broken("criterion", "memory_n", NO_MEMORY, "MemoryError: 1 TiB"),
    Broken("column", "raising_n", "return results['nothing']", "KeyError:"),
    Broken("column", "nothing_n", "return None", "values returns None, must be DataArray"),
    Broken("column", "nan_n", "return force * np.nan", "ValueError: values are not finite"),
    Broken("column", "text_n", "return force.astype(str)", "TypeError: "),
    Broken("column", "leaving_n", "sys.exit('gone')", "SystemExit: gone"),
    Broken("column", "memory_n", NO_MEMORY, "MemoryError: 1 TiB"),
    Broken("section", "raising", LONG, "RuntimeError: xxx"),
    Broken("section", "nothing", "return None", "blocks returns None, must be Sequence"),
    Broken("section", "text", "return ['words']", "blocks returns a str, must be "),
    Broken("section", "number", "return [va.blocks.Text(3)]", "a int in words, must be str"),
    Broken("section", "leaving", "sys.exit(0)", "SystemExit: 0"),
    Broken("section", "memory", NO_MEMORY, "MemoryError: 1 TiB"),
    Broken("stage", "raising", "raise TypeError(coords)", "TypeError: {'speed'"),
    Broken("stage", "nothing", "return None", "run returns None, must be Given"),
    Broken(
        "stage", "nan", STAMPED.format("nan", "np.nan * force.values"),
        "SchemaError: nan holds no number",
    ),
    Broken(
        "stage", "text", STAMPED.format("text", "force.values.astype(str)"),
        "SchemaError: text holds no numbers",
    ),
    Broken(
        "stage", "other", 'return va.Given(force.rename("level_total").to_dataset())',
        "SchemaError: ",
    ),
    Broken("stage", "leaving", "sys.exit(1)", "SystemExit: 1"),
    Broken("stage", "memory", NO_MEMORY, "MemoryError: 1 TiB"),
)  # fmt: skip


def written(folder: Path, one: Broken) -> Path:
    """The file of a broken plug-in."""
    file = folder / f"{one.noun.split()[-1]}_{one.name.replace('-', '_')}.py"
    file.write_text(IMPORTS + CODES[one.noun].format(name=one.name, body=one.body))
    return file


def line_of(file: Path, start: str) -> int:
    """Number of the first line of a file that begins so, but for blanks."""
    lines = file.read_text().splitlines()
    return next(at for at, line in enumerate(lines, 1) if line.lstrip().startswith(start))


@contextmanager
def forgetting() -> Iterator[None]:
    """Work after which the registries are as before."""
    assert report.render  # its registries are known
    modules = set(sys.modules)
    with ExitStack() as stack:
        for each in registry._REGISTRIES:
            len(each)  # fills it
            for name in ("_things", "_origins"):
                kept = dict(getattr(each, name))
                stack.enter_context(patch.object(each, name, kept))
        yield
    for name in set(sys.modules) - modules:
        if name.startswith("plugin_"):
            del sys.modules[name]


@pytest.fixture
def forgotten() -> Iterator[None]:
    """Registries that are as before after the test."""
    with forgetting():
        yield


class Ran(NamedTuple):
    """A run with all broken plug-ins at once."""

    code: int
    errors: str
    page: str
    results: Path


@pytest.fixture(scope="module")
def ran(tmp_path_factory) -> Ran:
    folder = tmp_path_factory.mktemp("broken")
    options = "".join(
        f'[options.my-{one.name}]\nkind = "{one.name}"\n\n'
        for one in LEFT_OUT
        if one.noun == "kind of option"
    )
    scale = "{ weight = 1.0, best = 0.0, worst = 1.0 }"
    criteria = "".join(f"{one.name} = {scale}\n" for one in LEFT_OUT if one.noun == "criterion")
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    text = text.replace("[receivers.", f"{options}[receivers.", 1)
    text = text.replace("[scoring.criteria]\n", f"[scoring.criteria]\n{criteria}")
    (folder / "study.toml").write_text(text)
    named = [word for one in LEFT_OUT for word in ("--plugin", written(folder, one))]
    run = partial(pipeline.run, radiation=made_up_radiation)
    with forgetting(), patch.object(pipeline, "run", run):
        outcome = command_here("run", folder / "study.toml", "--out", folder / "out", *named)
    page = (folder / "out" / "comparison.md").read_text().replace("\\", "")
    return Ran(outcome.returncode, outcome.stderr, page, folder / "out" / "results.nc")


def test_the_run_ends_well_but_not_complete(ran):
    assert ran.code == 3, ran.errors
    assert "Traceback" not in ran.errors
    assert len(ran.errors.splitlines()) == len(LEFT_OUT)
    results = open_results(ran.results)
    assert results["option"].values.tolist() == ["none", "counterweight-half"]
    assert results["criterion"].values.tolist() == ["foot_force_1x_n"]


@pytest.mark.parametrize("one", LEFT_OUT, ids=lambda one: f"{one.noun} {one.name}")
def test_is_left_out_and_named_in_one_line(ran, one):
    what = f"option my-{one.name}" if one.noun == "kind of option" else f"{one.noun} {one.name}"
    start = f"warning: {what} is omitted: "
    (line,) = [line for line in ran.errors.splitlines() if line.startswith(start)]
    file = ran.results.parents[1] / f"{one.noun.split()[-1]}_{one.name.replace('-', '_')}.py"
    where, number, words = re.fullmatch(r"(\S+\.py), line (\d+): (.*)", line[len(start) :]).groups()
    assert where == file.name
    if one.body.startswith(("raise", "1 /", "sys.exit")):
        assert int(number) == line_of(file, one.body)
    assert number != "1"
    assert one.words in words
    assert len(words) <= MOST_WORDS
    screen = ran.page.partition("\n## ")[2].partition("\n## ")[0]
    assert line.removeprefix("warning: ")[:60] in screen


SOURCE = """@va.register
class Odd(va.Source):
    kind = "odd"
    def loads(self, case, before):
        force = np.zeros((3, case.revolution.rotation.crank_angle.size))
        {body}
"""
FATAL_SOURCES = {
    "raising": ("1 / 0", "ZeroDivisionError: division by zero"),
    "nothing": ("return None", "loads returns None, must be Loads"),
    "wrong type": ("return {'odd': force}", "loads returns a dict, must be Loads"),
    "text": ("return va.Loads(figures={'odd_n': '3'})", "a str in figures, must be float"),
    "not a number": (
        "return va.Loads(wrenches={'odd': va.Wrench(force * np.nan, force)})",
        "loads returns numbers that are not finite in force_n",
    ),
    "shape": ("return va.Loads(wrenches={'odd': va.Wrench(force.T, force)})", "must be (3, "),
    "leaving": ("sys.exit(0)", "SystemExit: 0"),
    "memory": (NO_MEMORY, "MemoryError: 1 TiB"),
    "long": (LONG, "RuntimeError: xxx"),
}


def refused(words: list[object], *said: str) -> str:
    """The one line of a refusal by the command line of this process, which forgets the plug-ins."""
    with forgetting():
        outcome = command_here(*words)
    assert_refused(outcome, *said)
    (line,) = outcome.stderr.splitlines()
    assert len(line) < MOST_WORDS + 300
    return line


def study_with_source(folder: Path) -> Path:
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    study = folder / "study.toml"
    study.write_text(text.replace("[radiation]\n", '[sources.mine]\nkind = "odd"\n\n[radiation]\n'))
    return study


@pytest.mark.parametrize(("body", "said"), FATAL_SOURCES.values(), ids=FATAL_SOURCES)
def test_source_ends_the_run_in_one_line(tmp_path, body, said):
    file, study = tmp_path / "odd.py", study_with_source(tmp_path)
    file.write_text(IMPORTS + SOURCE.format(body=body))
    run = ["run", study, "--out", tmp_path / "out", "--plugin", file]
    refused(run, "kind of source odd: odd.py, line ", said, "--without mine")
    assert not (tmp_path / "out").exists()


IN_A_CHECK = """    @classmethod
    def why_not(cls, machine):
        sys.exit(5)
"""
IN_A_VALIDATOR = """    def model_post_init(self, context):
        raise LookupError("nowhere")
"""


@pytest.mark.parametrize(
    ("method", "said"),
    [(IN_A_CHECK, "line 12: SystemExit: 5"), (IN_A_VALIDATOR, "line 11: LookupError: nowhere")],
)
def test_source_fails_when_the_study_is_read(tmp_path, method, said):
    file, study = tmp_path / "odd.py", study_with_source(tmp_path)
    file.write_text(IMPORTS + SOURCE.format(body="return va.Loads()") + method)
    refused(["run", study, "--plugin", file], f"kind of source odd: odd.py, {said}", "--without")


AT_LOAD = {
    "applied_to": ("def applied_to(self, machine):\n        1 / 0", "line 11: ZeroDivisionError"),
    "applied_to gives": (
        "def applied_to(self, machine):\n        pass",
        "line 10: applied_to ",
    ),
    "validator": ("def model_post_init(self, context):\n        sys.exit()", "line 11: SystemExit"),
}


@pytest.mark.parametrize(("method", "said"), AT_LOAD.values(), ids=AT_LOAD)
def test_option_that_fails_when_the_study_is_read_is_left_out(forgotten, tmp_path, method, said):
    """The study remembers it, also with other values."""
    file, study_file = tmp_path / "odd.py", tmp_path / "study.toml"
    file.write_text(IMPORTS + OPTION.format(name="odd", body="return good") + f"    {method}\n")
    load_plugin(file)
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    text = text.replace("[receivers.", '[options.mine]\nkind = "odd"\n\n[receivers.', 1)
    study_file.write_text(text)
    with pytest.warns(UserWarning, match=f"option mine is omitted: odd.py, {said}"):
        study = load_study(study_file)
    assert list(study.options) == ["none", "counterweight-half"]
    (line,) = study.replace({"title": "Other"}).left_out
    assert said in line


def test_criterion_must_be_a_number_in_every_sample():
    sampled = xr.DataArray([[1.0, 2.0], [np.nan, 3.0]], dims=("sample", "option"))
    with pytest.raises(ParameterError, match="odd_n: by sample has values that are not finite"):
        criterion_values._of_samples("odd_n", sampled)
    assert criterion_values._of_samples("odd_n", sampled.fillna(0.0)).shape == (2, 2)


def test_run_goes_on_without_a_source(tmp_path, monkeypatch):
    """Which is said on the first screen; the exit code is that of a run as asked for."""
    study, run = study_with_source(tmp_path), partial(pipeline.run, radiation=made_up_radiation)
    monkeypatch.setattr(pipeline, "run", run)
    outcome = command_here("run", study, "--out", tmp_path, "--without", "mine")
    assert outcome.returncode == 0, outcome.stderr
    page = (tmp_path / "comparison.md").read_text()
    first = page.partition("\n## ")[2].partition("\n## ")[0]
    assert "source mine is omitted: as asked for by --without" in first
    assert "source mine is omitted" in outcome.stdout


def test_a_source_that_is_not_there_cannot_be_left_out(tmp_path):
    said = "--without other: there is no such source; sources are mine"
    refused(["run", study_with_source(tmp_path), "--without", "other"], said)


MACHINES = {
    "raising": ("raise OSError('no such disk')", "OSError: no such disk"),
    "nothing": ("return None", "revolution returns None, must be Revolution"),
    "leaving": ("import sys; sys.exit(3)", "SystemExit: 3"),
    "not a number": (
        "rotation = vibroacoustics.constant_rotation(speed_rpm * float('nan'), samples)\n"
        "        return vibroacoustics.Revolution(speed_rpm, rotation, {})",
        "revolution returns numbers that are not finite in speed_rad_per_s",
    ),
    "samples": (
        "rotation = vibroacoustics.constant_rotation(speed_rpm, samples + 1)\n"
        "        return vibroacoustics.Revolution(speed_rpm, rotation, {})",
        "ValueError: rotation: shape",
    ),
}


@pytest.mark.parametrize(("body", "said"), MACHINES.values(), ids=MACHINES)
def test_machine_ends_the_run_in_one_line(tmp_path, body, said):
    study, file = rotor_study(tmp_path), tmp_path / "rotor.py"
    head = "    def revolution(self, speed_rpm, samples):\n"
    code = (THIRD_PARTY / "lone_rotor.py").read_text()
    code = re.sub(r"    def revolution\(.*\n", f"{head}        {body}\n", code)
    file.write_text(code)
    run = ["run", study, "--out", tmp_path / "out", "--plugin", file]
    refused(run, "kind of machine lone-rotor: rotor.py, line ", said)


READER = """def read(request):
    {body}
va.register(va.Reader("odd", (".odd",), "odd bytes", read))
"""
READERS = {
    "raising": ("1 / 0", "line 5: ZeroDivisionError: division by zero"),
    "nothing": ("return None", "line 4: read returns None, must be Recorded"),
    "text": ("return va.Recorded(['a'], ['V'], [['1']], 1e3)", "a list in samples"),
    "not a number": (
        "return va.Recorded(['a'], ['V'], [np.full(99, np.nan)], 1e3)",
        "numbers that are not finite in samples",
    ),
    "rate": ("return va.Recorded(['a'], ['V'], [np.zeros(99)], '1 kHz')", "a str in sample_rate"),
    "leaving": ("sys.exit(4)", "line 5: SystemExit: 4"),
    "long": (LONG, "line 5: RuntimeError: xxx"),
}


@pytest.mark.parametrize(("body", "said"), READERS.values(), ids=READERS)
def test_reader_fails_in_one_line(forgotten, tmp_path, body, said):
    """In this process; the child hands the line over."""
    (tmp_path / "odd.py").write_text(IMPORTS + READER.format(body=body))
    (tmp_path / "some.odd").write_bytes(bytes(100))
    header, rows = answer(Request(tmp_path / "some.odd", None, None), str(tmp_path / "odd.py"))
    assert header["error"] == "FaultError"
    assert "reader odd: odd.py, " in header["message"]
    assert said in header["message"]
    assert len(header["message"]) < MOST_WORDS + 100
    assert not rows


def test_reader_that_leaves_ends_the_command(tmp_path):
    (tmp_path / "odd.py").write_text(IMPORTS + READER.format(body="sys.exit(4)"))
    (tmp_path / "some.odd").write_bytes(bytes(100))
    words = ["orders", tmp_path / "some.odd", "--rpm", "3000", "--plugin", tmp_path / "odd.py"]
    refused(words, "some.odd: reader odd: odd.py, line 5: SystemExit: 4")


LOADING = {
    "raising": ("raise ValueError('no')", "line 4: ValueError: no"),
    "leaving": ("sys.exit(0)", "line 4: SystemExit: 0"),
    "interrupted": (INTERRUPT, "line 4: KeyboardInterrupt"),
    "memory": (NO_MEMORY, "line 4: MemoryError: 1 TiB"),
    "own": ("class Own(BaseException): ...\nraise Own('mine')", "line 5: Own: mine"),
    "syntax": ("1 +", "line 4: SyntaxError"),
    "long": (LONG, "line 4: RuntimeError: xxx"),
    "reads": (
        STAGE.format(name="odd", body="pass").replace('("force_amplitude",)', "None"),
        "reads is None, must be tuple",
    ),
    "label": (
        CRITERION.format(name="odd_n", body="pass").replace("def value(", "label = 3\n    def a("),
        "label is a int, must be str",
    ),
    "no method": (
        CRITERION.format(name="odd_n", body="pass").replace("def value(", "value = 3\n    def a("),
        "value is no method",
    ),
    "head": ('va.register(va.Section("odd", 3, lambda _: []))', "title is a int, must be str"),
}  # fmt: skip


@pytest.mark.parametrize(("code", "said"), LOADING.values(), ids=LOADING)
def test_file_that_cannot_be_loaded_is_refused(tmp_path, code, said):
    (tmp_path / "odd.py").write_text(IMPORTS + code)
    refused(["run", TINY, "--plugin", tmp_path / "odd.py"], "odd.py, line ", said)


def test_a_signal_ends_what_a_plugin_does(tmp_path):
    """It is no fault of the plug-in: nothing is omitted because of it."""
    (tmp_path / "slow.py").write_text("import signal\nsignal.raise_signal(signal.SIGINT)\n")
    with forgetting(), pytest.raises(KeyboardInterrupt):
        load_plugin(tmp_path / "slow.py")


def test_unknown_kind_names_the_way_to_bring_one(tmp_path):
    said = "sources.mine.kind = odd: unknown"
    line = refused(["run", study_with_source(tmp_path)], said)
    assert line.endswith("; others by --plugin")


def test_single_samples_without_a_source_have_no_solution(forgotten, tmp_path):
    """With the number of the first one."""
    file = tmp_path / "few.py"
    body = "if before: sys.exit(3)\n        return va.Loads()"
    file.write_text(IMPORTS + SOURCE.replace('"odd"', '"few"').format(body=body))
    load_plugin(file)
    source = SOURCES["few"]()
    with pytest.warns(
        UserWarning, match=r"1 of 3 samples .* sample 2: kind of source few: few.py, line"
    ):
        loads = in_every_sample(
            [{("a", "b"): value} for value in (0.0, 1.0, 0.0)],
            lambda sample: bool(source.loads(Sampled, sample["a", "b"])),
            False,
            lambda _: None,
        )
    assert loads == [True, False, True]


class Sampled:
    """As much of a case as the source reads."""

    class revolution:  # noqa: N801
        class rotation:  # noqa: N801
            class crank_angle:  # noqa: N801
                size = 8


def test_refusal_of_a_plugin_stays_a_refusal(forgotten, tmp_path):
    """`ParameterError` says that the user's value is wrong."""
    file = tmp_path / "strict.py"
    body = "raise va.ParameterError('length_m = 3 m: too long')"
    file.write_text(IMPORTS + SOURCE.replace('"odd"', '"strict"').format(body=body))
    load_plugin(file)
    with pytest.raises(ParameterError, match=r"^length_m = 3 m: too long$"):
        SOURCES["strict"]().loads(Sampled, {})


def test_installed_thing_that_cannot_be_loaded_is_left_out(tmp_path, monkeypatch):
    """With a line, and named where it is asked for."""
    (tmp_path / "sadly_broken.py").write_text("import sys\nsys.exit('gone')\n")
    information = tmp_path / "sad-1.dist-info"
    information.mkdir()
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: sad\nVersion: 1\n")
    (information / "entry_points.txt").write_text("[sad.things]\nsad = sadly_broken:Sad\n")
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setattr(registry, "_REGISTRIES", [])
    things = registry.Registry("thing", Sampled, "name", "base", "sad.things")
    said = r"thing sad.* sadly_broken.py, line 2: SystemExit: gone"
    with pytest.warns(UserWarning, match=said):
        assert not list(things)
    with pytest.raises(registry.FaultError, match=said):
        things["sad"]
