"""A small study of inner sources, with transfer vectors made up."""

import numpy as np
import xarray as xr
from support import ROOT, made_up_transfer_vectors

from vibroacoustics import pipeline
from vibroacoustics.parameters.study import Study
from vibroacoustics.pipeline.inner_keys import Operating
from vibroacoustics.pipeline.inner_sound import ShellPath, shell_path
from vibroacoustics.schema import stamp

INSIDE_STUDY = ROOT / "tests" / "studies" / "inside.toml"


def made_up_modes(study: Study, gain: float = 1.0) -> xr.Dataset:
    """Transfer vectors of rigid motions and of the shell's modes, different for each."""
    vectors = made_up_transfer_vectors(study)
    names = [motion.name for motion in path_of(study).modes] if study.inside else []
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


def operating_of(study: Study, revolutions: int = 2) -> Operating:
    """The study's only speed."""
    (speed,) = study.operation.speed_rpm
    return Operating(speed, 50.0, study.radiation.maximum_frequency_hz, revolutions)
