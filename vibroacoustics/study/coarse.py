"""A study made coarser for a first look, and what that may cost in accuracy."""

from math import sqrt
from typing import Any, Final

from ..base.constants import SPEED_OF_SOUND_M_PER_S
from .radiation import BODY_SPACING_M
from .study import Study

MOST_SPEEDS: Final = 7
LEAST_SAMPLES: Final = 8
_FEWER_SAMPLES: Final = 5
_COARSER_GRID: Final = 1.5
_NODES_PER_WAVE: Final = 8.0
_HIGHEST_IN_ROOM_HZ: Final = 710.0
"""End of the third octave of 630 Hz, from which on the diffuse field is used alone."""
_END: Final = 0.05
"""Share of the samples beyond each end of a band of 90 %."""
_DENSITY: Final = 0.1031
"""Density of the normal distribution at its 5 % quantile."""


def coarse(study: Study) -> Study:
    """The study with fewer speeds and samples, a coarser grid, a room to 710 Hz and without k-Wave.

    `coarsened` of the result says what was changed and what error is expected.

    Parameters
    ----------
    study : from `load_study`
    """
    changes = [
        change
        for part in (_speeds, _room, _waves_in_room, _grid, _samples, _sliders)
        if (change := part(study)) is not None
    ]
    values: dict[str, Any] = {}
    for changed, _ in changes:
        values |= changed
    words = tuple(words for _, words in changes)
    coarser = study.replace(values) if values else study
    return coarser.marked_coarse(words) if words else study


_Change = tuple[dict[str, Any], str] | None
"""Values to replace, and the words for it; none where nothing is to be done."""


def _speeds(study: Study) -> _Change:
    operation = study.operation
    speeds, supplies = operation.speed_rpm, operation.supply_frequency_hz
    if len(speeds) <= MOST_SPEEDS:
        return None
    last = len(speeds) - 1
    kept = {round(step * last / (MOST_SPEEDS - 1)) for step in range(MOST_SPEEDS)}
    published = study.catalogue_speed_rpm
    kept |= {number for number, speed in enumerate(speeds) if speed == published}
    chosen = sorted(kept)
    values: dict[str, Any] = {"operation.speed_rpm": [speeds[number] for number in chosen]}
    if supplies is not None:
        values["operation.supply_frequency_hz"] = [supplies[number] for number in chosen]
    return values, f"{len(chosen)} of {len(speeds)} speeds; resonances between them are not seen"


def _room(study: Study) -> _Change:
    if study.radiation.room_solver == "closed-form":
        return None
    words = (
        "image sources in closed form instead of k-Wave in the room: 0.1 dB, and exact for hard "
        "walls"
    )
    return {"radiation.room_solver": "closed-form"}, words


def _waves_in_room(study: Study) -> _Change:
    room = study.room
    if room is None or room.maximum_frequency_hz <= _HIGHEST_IN_ROOM_HZ:
        return None
    words = (
        f"waves in the room to {_HIGHEST_IN_ROOM_HZ:g} instead of {room.maximum_frequency_hz:g} "
        "Hz: for a machine in the niche of a kitchen 0.3 dB, in single third octaves 0.8 dB"
    )
    return {"room.maximum_frequency_hz": _HIGHEST_IN_ROOM_HZ}, words


def _grid(study: Study) -> _Change:
    settings = study.radiation
    automatic = settings.near_field_spacing_m is None
    spacing = settings.near_field_spacing_m or settings.wave_spacing_m
    largest = SPEED_OF_SOUND_M_PER_S / settings.maximum_frequency_hz / _NODES_PER_WAVE
    coarser = 1e-4 * int(1e4 * min(_COARSER_GRID * spacing, largest, 0.05))
    cabinet = settings.surroundings.cabinet
    # The body decides on an automatic grid below 4 kHz, which is coarse already.
    by_body = automatic and spacing > BODY_SPACING_M
    if settings.revolution or cabinet is not None or by_body or coarser <= spacing:
        return None
    words = (
        f"cut cells of {1e3 * coarser:g} instead of {1e3 * spacing:.3g} mm: their error grows "
        f"{(coarser / spacing) ** 2:.2g} times; its estimate is under Radiation"
    )
    return {"radiation.near_field_spacing_mm": 1e3 * coarser}, words


def _samples(study: Study) -> _Change:
    wanted = study.uncertainty.random_samples
    fewer = max(LEAST_SAMPLES, wanted // _FEWER_SAMPLES)
    if not study.ranges or fewer >= wanted:
        return None
    before, after = (standard_error_of_end(samples) for samples in (wanted, fewer))
    words = (
        f"{fewer} instead of {wanted} effective samples: each end of a band of 90 % has a standard "
        f"error of {after:.2f} instead of {before:.2f} standard deviations of the level"
    )
    return {"uncertainty.random_samples": fewer}, words


def _sliders(study: Study) -> _Change:
    return ({}, "no sliders of parameters") if study.ranges and study.baseline is None else None


def standard_error_of_end(samples: int) -> float:
    """Standard error of the 5 % quantile of so many samples, over the standard deviation.

    √(p (1 - p)/n)/φ, for samples from a normal distribution (David and Nagaraja, Order Statistics,
    2003, section 10.2).
    """
    return sqrt(_END * (1.0 - _END) / samples) / _DENSITY
