"""Inputs of the transfer vectors of a study."""

from collections.abc import Mapping, Sequence

from ..machine.shell import Shell
from ..study.radiation import RadiationSettings
from ..study.receivers import Receiver
from ..study.study import Study
from .patterns import SurfaceMotion
from .sound_field import SoundField

Inputs = tuple[
    Shell,
    Mapping[str, Receiver],
    RadiationSettings,
    SoundField,
    Sequence[SurfaceMotion],
    tuple[str, ...],
]
"""Arguments of `transfer_vectors`, `task_of` and `cache_key_material`."""


def inputs_of(study: Study, motions: Sequence[SurfaceMotion]) -> Inputs:
    """Return what the transfer vectors of a study follow from."""
    at_all = study.radiation.kwave_receivers == "all"
    by_kwave = tuple(study.receivers) if at_all else (study.catalogue_receiver,)
    shell, settings = study.machine.shell, study.radiation
    return shell, study.receivers, settings, SoundField.of_study(study), motions, by_kwave
