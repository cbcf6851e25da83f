"""A small study of several sources, with transfer vectors made up."""

from unittest.mock import patch

import numpy as np
import xarray as xr
from kept_results import kept
from support import ROOT, made_up_transfer_vectors

from vibroacoustics import pipeline
from vibroacoustics.base.vocabulary import REFERENCE_OPTION, stamp
from vibroacoustics.machine.frame import PARTS
from vibroacoustics.machine.source import Case
from vibroacoustics.mechanics.loads import Lines, Loads, lines_of
from vibroacoustics.sources.cases import cases_of
from vibroacoustics.stages.samples import Samples
from vibroacoustics.stages.shell import shell_path
from vibroacoustics.stages.stage import Given
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study
from vibroacoustics.transfer.path import ShellPath

NO_DISCREPANCY = {
    f"uncertainty.{name}_deviation_db": 0.0 for name in ("path", "source", "band", "added")
}
"""Samples whose model is right but for the values of their ranges."""
RATED = {
    "rating.rules": "ta-laerm",
    "rating.windows.office": {
        "receiver": "left_1m", "area": "commercial", "operating_min": 30.0
    },
    "rating.windows.workshop": {"receiver": "left_1m", "area": "industrial"},
    "rating.windows.bedroom": {"receiver": "front_1m", "area": "mixed"},
}  # fmt: skip
"""Windows, in the order of a study file; the last is the worst."""
SOURCES_STUDY = ROOT / "tests" / "studies" / "sources_made_up.toml"


def made_up_modes(study: Study, gain: float = 1.0) -> xr.Dataset:
    """Transfer vectors of rigid motions and of the shell's modes, different for each."""
    vectors = made_up_transfer_vectors(study)
    names = [motion.name for motion in path_of(study).modes] if study.drives_shell else []
    frequency = vectors["frequency"].values
    generator = np.random.default_rng(5)
    shape = (len(study.receivers), len(names), 1)
    size = generator.standard_normal(shape) + 1j * generator.standard_normal(shape)
    coords = {"receiver": list(study.receivers), "pattern": names, "frequency": frequency}
    if names:
        values = 0.01 * gain * size * frequency
        vectors["pattern_transfer_vector"] = stamp("pattern_transfer_vector", values, coords)
    return vectors


def path_of(study: Study) -> ShellPath:
    path = shell_path(study)
    assert path is not None
    return path


def run_made_up(study: Study, gain: float = 1.0) -> xr.Dataset:
    """Results with made-up transfer vectors."""
    return pipeline.run(study, radiation=lambda study, *_: (made_up_modes(study, gain), False))


def sources_run() -> xr.Dataset:
    """Results of the study as it is, with made-up transfer vectors."""
    return kept("sources", lambda: run_made_up(load_study(SOURCES_STUDY)))


def rated_run() -> xr.Dataset:
    """Results of the study with three windows, with made-up transfer vectors."""
    return kept("rated", lambda: run_made_up(load_study(SOURCES_STUDY).replace(RATED)))


def nominal_run() -> xr.Dataset:
    """Results of the same study and shell with the nominal values alone: no sample goes on."""

    def run() -> xr.Dataset:
        with patch.object(Samples, "run", lambda *_: Given()):
            return run_made_up(load_study(SOURCES_STUDY))

    return kept("sources_nominal", run)


def case_of(study: Study, option: str = REFERENCE_OPTION) -> Case:
    """An option at the study's only speed."""
    (speed,) = study.operation.speed_rpm
    return cases_of(study, lambda *_: None)[speed, option]


def all_lines(case: Case, loads: dict[str, Loads]) -> Lines:
    """The lines of all sources up to the highest frequency."""
    return lines_of(loads, case.shaft_frequency_hz, case.maximum_order)


def on_parts(loads):
    """Loads on all parts by part, those on none as zeros; other ports left out."""
    shape = next(load.shape for port, load in loads.items() if port in PARTS)
    return {part: loads.get(part, np.zeros(shape)) for part in PARTS}


def with_tables(study: Study, **tables: dict[str, object]) -> Study:
    """The study with values of tables of its machine replaced, unchecked."""
    machine = study.machine
    changed = {
        name: getattr(machine, name).model_copy(update=values) for name, values in tables.items()
    }
    return study.model_copy(update={"machine": machine.model_copy(update=changed)})
