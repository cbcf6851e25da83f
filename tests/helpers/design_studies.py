"""Studies with a design space, and designs of them beside plain runs."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr
from support import ROOT, TINY, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.base.arrays import Array
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.base.decibel import mean_square_level
from vibroacoustics.design.engine.engine import Engine
from vibroacoustics.design.engine.machine_sample import MachineSample, Unmodelled
from vibroacoustics.design.engine.needs import Need
from vibroacoustics.design.engine.sound_path import SoundPaths
from vibroacoustics.design.space import Space
from vibroacoustics.radiation.given import Radiation
from vibroacoustics.results.estimates import nominal_values
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study

LEFT = "[receivers.left_1m]\nx_mm = -541.3\ny_mm = 937.5\nheight_mm = 230.0\n"
WEIGHT = """
[options.weight]
kind = "counterweight"
mass_g = 50.0
radius_mm = 20.0
angle_deg = 180.0
height_mm = 30.0
"""
OBJECTIVE = '[design.objectives.quiet]\nfigure = "level_dba"\n'
SILENT_DB = -100.0
NEEDS = (
    Need("sound"), Need("sound", 1), Need("sound", 2), Need("force", 1), Need("moment", 1),
    Need("foot", 1), Need("figure", None, "added_mass_kg"),
)  # fmt: skip


def study_with(text: str, base: Path = TINY) -> Study:
    """A study of tests or pipelines with further tables."""
    written = base.read_text().replace("../../data", str(ROOT / "data"))
    written = written.replace('"../data', f'"{ROOT / "data"}').replace('"../../', f'"{ROOT}/')
    with TemporaryDirectory() as folder:
        file = Path(folder) / "study.toml"
        file.write_text(f"{written}\n{text}")
        return load_study(file)


def design_table(option: str, variables: dict[str, str]) -> str:
    """Table `design` with variables, each with what stands between the braces."""
    lines = [f'"{key}" = {{ {values} }}' for key, values in variables.items()]
    return "\n".join([f"[design]\noption = {option}", "[design.variables]", *lines, OBJECTIVE])


def engine_of(
    study: Study, needs: tuple[Need, ...] = NEEDS, radiation: Radiation = made_up_radiation
) -> Engine:
    """Engine of the study's designs."""
    space = Space.of(study)
    machine = MachineSample(np.ones(1), lambda _: Unmodelled(np.zeros((1, 1, 1)), np.zeros(1)))
    gains = (None,) * len(study.operation.speed_rpm)
    return Engine(space, space.limits, needs, SoundPaths(radiation), machine, gains)


def largest_difference_db(
    engine: Engine, study: Study, designs: Array, radiation: Radiation = made_up_radiation
) -> float:
    """Between engine and pipeline, of all that is seen of designs."""
    outcome = engine.outcome(designs)
    assert not outcome.failed
    runs = [_run(engine, study, design, radiation) for design in designs]
    return max(
        _of_need(need, seen[row], run)
        for row, run in enumerate(runs)
        for need, seen in outcome.results.items()
    )


def _run(engine: Engine, study: Study, design: Array, radiation: Radiation) -> xr.Dataset:
    changed = study.replace(engine.space.written(design))
    results = nominal_values(pipeline.run(changed, radiation=radiation))
    return results.sel(option=engine.space.option_of(design))


def _of_need(need: Need, seen: Array, run: xr.Dataset) -> float:
    amplitudes = {"force": "force_amplitude", "moment": "moment_amplitude"}
    if need.what == "sound":
        level = mean_square_level(seen, REFERENCE_PRESSURE_PA)
        if need.order is None:
            expected = run["level_modelled"].sel(weighting="A")
        else:
            expected = run["order_level"].sel(weighting="Z", order=need.order)
        silent = np.maximum(SILENT_DB, expected.values)  # rounding below
        return float(np.abs(np.maximum(SILENT_DB, level) - silent).max())
    if need.what == "figure":
        expected = run["reported_figure"].sel(figure=need.name)
    else:
        expected = run[amplitudes.get(need.what, "foot_force_amplitude")].sel(order=need.order)
    largest = max(float(np.abs(expected).max()), 1e-9)
    return float(np.abs(seen - expected.values).max() / largest)
