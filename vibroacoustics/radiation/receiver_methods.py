"""Method of each microphone, and why k-Wave does not compute it: from the study's settings."""

from collections.abc import Collection, Iterable, Mapping
from typing import Final, NamedTuple

import xarray as xr

from ..study.radiation import KWAVE_LIMIT_HZ, RadiationSettings

_OUTDOORS: Final = "k-Wave has no ground and no barrier"
_CLOSED_FORM: Final = 'room_solver = "closed-form"'
_HIGH: Final = "above, the grid of k-Wave would be too large"


class ReceiverMethod(NamedTuple):
    """Method of the sound pressure at a microphone.

    Attributes
    ----------
    method : on the machine side and on the room side
    reason : why k-Wave does not compute the microphone, or a part of its frequencies; else empty
    """

    method: str
    reason: str


GIVEN: Final = ReceiverMethod("given transfer vectors", "transfer vectors are given to the run")
MEASURED: Final = ReceiverMethod("measured sound by force", "measured.sound is given")


def receiver_methods(
    receivers: Iterable[str], settings: RadiationSettings, by_kwave: Collection[str]
) -> dict[str, ReceiverMethod]:
    """Method and reason of each microphone, by name."""
    machine, closed = machine_side(settings), closed_form(settings)
    limited = settings.maximum_frequency_hz > KWAVE_LIMIT_HZ
    kwave = f"k-Wave to {KWAVE_LIMIT_HZ:g} Hz, {closed} above" if limited else "k-Wave"
    of_kwave = ReceiverMethod(f"{machine}, {kwave}", _HIGH if limited else "")
    other = ReceiverMethod(f"{machine}, {closed}", _reason(settings, by_kwave))
    return {name: of_kwave if name in by_kwave else other for name in receivers}


def with_methods(vectors: xr.Dataset, methods: Mapping[str, ReceiverMethod]) -> xr.Dataset:
    """Transfer vectors with method and reason of each microphone as coordinates."""
    of_receivers = [methods[str(name)] for name in vectors["receiver"].values]
    return vectors.assign_coords(
        radiation_method=("receiver", [choice.method for choice in of_receivers]),
        radiation_method_reason=("receiver", [choice.reason for choice in of_receivers]),
    )


def machine_side(settings: RadiationSettings) -> str:
    """Name of the method by which the body radiates."""
    return "boundary elements" if settings.revolution else "cut cells"


def closed_form(settings: RadiationSettings) -> str:
    """Name of the closed form by which sound travels where k-Wave does not compute it."""
    outdoors = settings.surroundings.is_outdoors
    return "spherical waves over ground" if outdoors else "image sources"


def _reason(settings: RadiationSettings, by_kwave: Collection[str]) -> str:
    if settings.surroundings.is_outdoors:
        return _OUTDOORS
    if settings.room_solver == "closed-form":
        return _CLOSED_FORM
    return f'k-Wave computes {", ".join(by_kwave)} (kwave_receivers = "{settings.kwave_receivers}")'
