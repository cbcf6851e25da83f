"""A study whose radiation and room are measured: sound pressure by force."""

import xarray as xr

from ..base.errors import ParameterError
from ..base.progress import no_progress
from ..base.units import shaft_frequency_hz
from ..measured.sound_functions import read_force_sound
from ..radiation.given import given_radiation
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.force_sound import ForceSound


def measured_force_sound(study: Study) -> ForceSound | None:
    """Measured pressure per force; none where the study names none.

    Raises
    ------
    ParameterError
        The files do not fit, or the study asks for what they cannot tell.
    StorageError
        A file cannot be read.
    """
    settings = None if study.measured is None else study.measured.sound
    if settings is None:
        return None
    fields = ("sound_power", "map", "directivity")
    asked = [name for name in fields if getattr(study, name) is not None]
    asked += ["operation.stopping"] * study.operation.stopping
    asked += ["sources that drive an elastic shell"] * study.drives_shell
    if asked:
        raise ParameterError(
            f"measured.sound: tells the sound of forces at the microphones alone; leave out "
            f"{asked[0]}"
        )
    given = on_mounts(study.machine)
    for name, option in study.options.items():
        if not settings.is_at_feet and on_mounts(option.applied_to(study.machine)) != given:
            raise ParameterError(
                f"measured.sound: options.{name}: stands otherwise than the machine that was hit; "
                "hit the floor under the feet, or leave the option out"
            )
    sound = read_force_sound(settings, list(study.receivers), given)
    lowest = shaft_frequency_hz(min(study.operation.speed_rpm))
    if sound.frequency_hz[0] > lowest:
        raise ParameterError(
            f"measured.sound: begins at {sound.frequency_hz[0]:g} Hz, above the first order, "
            f"{lowest:g} Hz"
        )
    return sound


def force_radiation(study: Study, sound: ForceSound) -> tuple[xr.Dataset, bool]:
    """Transfer vectors of the machine as given, for tables and figures."""
    vectors = sound(sound.frequency_hz)
    return given_radiation(vectors, sound.frequency_hz)(study, no_progress, ())
