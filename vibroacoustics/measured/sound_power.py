"""Sound power of a machine from recordings of microphones on a surface around it (ISO 3744)."""

import warnings
from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.allowed import check_range
from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError
from ..base.vocabulary import label_coordinates, stamped
from ..levels.bands import measurable_bands
from ..levels.measured_power import BANDS, MeasuredPower, a_weighted_sum, measured_power, spread_dba
from ..levels.signal_levels import band_levels
from ..levels.sound_power import (
    LARGEST_ENVIRONMENT_CORRECTION_DB,
    box_area_m2,
    hemisphere_area_m2,
)
from ..radiation.arrangements import TABLE_B1, box_positions
from ..recordings import LabelledBlocks
from ..recordings.equality import identities
from ..recordings.remarks import RecordingWarning
from ..results import provenance
from ..results.claim_kinds import GRADE, POWER_LEVEL
from ..results.conditional import ConditionalClaim, Finding, with_claims
from ..study.sound_power import MINIMUM_BACKGROUND_MARGIN_DB


@dataclass(frozen=True)
class MeasurementSurface:
    """A hemisphere or a parallelepiped over a hard floor (ISO 3744:2010, 7.2).

    Attributes
    ----------
    name : in words, with its sizes
    area_m2 : area of the surface
    positions : numbers of microphones that the standard has for it

    Examples
    --------
    >>> round(va.MeasurementSurface.hemisphere(1.0).area_m2, 2)
    6.28
    >>> va.MeasurementSurface.box(0.3, 0.2, 0.4, 1.0).positions
    (9,)
    """

    name: str
    area_m2: float
    positions: tuple[int, ...]

    @classmethod
    def hemisphere(cls, radius_m: float) -> "MeasurementSurface":
        """A hemisphere with 10 or 20 microphones (Table B.1).

        Raises
        ------
        ParameterError
            The radius is out of range.
        """
        check_range("radius_m", radius_m, 0.5, 16.0, "m")
        area = hemisphere_area_m2(radius_m)
        return cls(f"hemisphere of {radius_m:g} m", area, (len(TABLE_B1) // 2, len(TABLE_B1)))

    @classmethod
    def box(
        cls, length_m: float, width_m: float, height_m: float, distance_m: float
    ) -> "MeasurementSurface":
        """A parallelepiped around a reference box (7.2.4, Annex C).

        Parameters
        ----------
        length_m, width_m, height_m : edges of the smallest box around the machine
        distance_m : from it to the microphones

        Raises
        ------
        ParameterError
            A length is out of range.
        """
        edges = {"length_m": length_m, "width_m": width_m, "height_m": height_m}
        for key, edge in edges.items():
            check_range(key, edge, 0.01, 20.0, "m")
        check_range("distance_m", distance_m, 0.25, 16.0, "m")
        sizes = (length_m, width_m, height_m, distance_m)
        words = f"box {length_m:g} x {width_m:g} x {height_m:g} m at {distance_m:g} m"
        return cls(words, box_area_m2(*sizes), (len(box_positions(*sizes)),))


SILENT_MARGIN_DB: Final = 20.0
"""Level below the median of the positions at which a microphone is dead; assumed."""
BAND_HZ = [band.nominal_hz for band in BANDS]


def sound_power(
    recordings: Sequence[xr.Dataset],
    surface: MeasurementSurface,
    background: Sequence[xr.Dataset] = (),
    absorption_area_m2: float | Mapping[float, float] | None = None,
) -> xr.Dataset:
    """Sound power level in third octaves from 100 Hz to 10 kHz, and A-weighted (ISO 3744:2010).

    Parameters
    ----------
    recordings : from `read_recording`; every channel of sound pressure is a microphone
    surface : on which they stand
    background : recordings at these microphones while the machine stands still
    absorption_area_m2 : absorption area of the test room, one number or by nominal midband
        frequency; default: a free field over the floor

    Returns
    -------
    levels at each position, their mean, K1, K2 and the sound power level, by band and A-weighted;
    bands that cannot be measured at the sample rate are empty. Attribute `grade`: 2 (ISO 3744),
    3 (ISO 3746) or 0, neither; `missing_for_grade`: `background`, `K2` and others, without which
    no grade is stated; `conditional_claims`: level and grade with all conditions

    Raises
    ------
    ParameterError
        No channel is sound pressure, two have one name, the sample rate is below the bands, or the
        room's absorption area is wrong.

    Warns
    -----
    RecordingWarning
        Two files have equal bytes or samples: one position is measured twice, another is missing.

    Examples
    --------
    >>> noise = np.random.default_rng(1).standard_normal((10, 25600))  # Pa
    >>> names = [f"microphone {number}" for number in range(1, 11)]
    >>> recording = va.label_recording(noise, 25600.0, names, ["Pa"] * 10)
    >>> power = va.sound_power([recording], va.MeasurementSurface.hemisphere(1.0))
    >>> round(power["measured_power_level_a"].item())
    101
    """
    levels = _levels_of(recordings)
    quiet = _levels_of(background) if background else None
    remarks = [*_kept_remarks(recordings), *_repeated([*recordings, *background])]
    area = None if absorption_area_m2 is None else _by_band(absorption_area_m2)
    measured_db = np.array(list(levels.values()))
    still = None if quiet is None else np.array(list(quiet.values()))
    measured = measured_power(measured_db, still, surface.area_m2, area)
    grade, power = _claims(measured, levels, quiet, surface)
    missing = [check.needed for check in grade.missing("no value")]
    labelled = _labelled(list(levels), measured_db, measured)
    labelled.attrs = {
        **provenance.software_attributes("sound power of recordings"),
        "title": f"Sound power of {provenance.recording_name(recordings[0].attrs)}",
        "source_files": ", ".join(
            provenance.recording_name(recording.attrs) for recording in recordings
        ),
        "surface": surface.name,
        "surface_m2": surface.area_m2,
        "grade": 0 if missing else measured.grade or 0,
        "missing_for_grade": ", ".join(missing),
        "spread_dba": spread_dba(measured_db),
        "positions_of_the_standard": list(surface.positions),
        **({"reading_remarks": "; ".join(remarks)} if remarks else {}),
    }
    return label_coordinates(with_claims(labelled, (grade, power)))


GRADES: Final = {
    2: "grade 2 (ISO 3744, engineering)",
    3: "grade 3 (ISO 3746, survey), not grade 2",
    None: "neither grade 2 (ISO 3744) nor grade 3 (ISO 3746)",
}


def _claims(
    measured: MeasuredPower,
    levels: Mapping[str, Array],
    quiet: Mapping[str, Array] | None,
    surface: MeasurementSurface,
) -> tuple[ConditionalClaim, ConditionalClaim]:
    """Grade and A-weighted level, with what the microphones and their bands lack."""
    by_position = np.array(list(levels.values()))
    levels_dba = a_weighted_sum(by_position)
    is_dead = levels_dba < np.median(levels_dba) - SILENT_MARGIN_DB
    dead = [name for name, silent in zip(levels, is_dead, strict=True) if silent]
    complete = int(np.isfinite(by_position).all(axis=0).sum())
    count, behind = len(levels), 0 if quiet is None else len(quiet)
    margin_dba, k2_dba = measured.margin_dba, measured.environment_dba
    is_clear = not margin_dba < MINIMUM_BACKGROUND_MARGIN_DB
    needed = f"{' or '.join(map(str, surface.positions))} microphones"
    room = "stated" if measured.has_environment else "not stated"
    shared = {
        "background": Finding(f"{behind} positions", quiet is not None),
        "room": Finding(room, measured.has_environment),
        "sound": Finding(
            f"{count - len(dead)} of {count}",
            not dead,
            f"sound at {', '.join(dead)}" if dead else "",
        ),
        "bands": Finding(f"{BAND_HZ[complete - 1] / 1000.0:g} kHz", complete == len(BAND_HZ)),
    }
    margin = f"{rounding.fixed(margin_dba)} dB"
    of_grade = {
        "microphones": Finding(f"{count} microphones", count in surface.positions, needed),
        "background positions": Finding(f"{behind} of {count}", quiet is None or behind == count),
        "margin": Finding(margin, is_clear),
        "K2A": Finding(f"{rounding.fixed(k2_dba)} dB", k2_dba <= LARGEST_ENVIRONMENT_CORRECTION_DB),
    }
    level = f"{rounding.fixed(measured.power_dba)} dB(A) re 1 pW"
    return (
        GRADE.claim(GRADES[measured.grade], shared | of_grade),
        POWER_LEVEL.claim(level, shared | {"margin": Finding(margin, is_clear)}),
    )


def _kept_remarks(recordings: Sequence[xr.Dataset]) -> Iterator[str]:
    """Remarks of the reading, with the file before them."""
    for recording in recordings:
        if "reading_remarks" in recording.attrs:
            name = provenance.recording_name(recording.attrs)
            yield f"{name}: {recording.attrs['reading_remarks']}"


def _repeated(recordings: Sequence[xr.Dataset]) -> list[str]:
    """Warn of each recording that is another one again."""
    first: dict[Hashable, str] = {}
    lines: dict[int, str] = {}
    for number, recording in enumerate(recordings):
        blocks, file = LabelledBlocks(recording), provenance.recording_name(recording.attrs)
        for mark in identities(blocks, blocks.channels):
            if mark in first:
                again = f"{file}: has {mark[0]} of {first[mark]}: record each position"
                lines.setdefault(number, again)
            first.setdefault(mark, file)
    for line in lines.values():
        warnings.warn(line, RecordingWarning, stacklevel=3)
    return list(lines.values())


def _levels_of(recordings: Iterable[xr.Dataset]) -> dict[str, Array]:
    """Levels (band,) by microphone; not a number in bands beyond the sample rate."""
    levels: dict[str, Array] = {}
    recordings = list(recordings)
    for recording in recordings:
        rate_hz = float(recording.attrs["sample_rate_hz"])
        bands = measurable_bands(BANDS, rate_hz)
        if not bands:
            raise ParameterError(
                f"{provenance.recording_name(recording.attrs)}: sample rate = {rate_hz:g} Hz: "
                "must be above "
                f"{2.0 * BANDS[0].upper_hz:.4g} Hz for the third octave at {BAND_HZ[0]:g} Hz"
            )
        for name, unit in zip(
            map(str, recording["channel"].values), recording["channel_unit"].values, strict=True
        ):
            if unit != "Pa":
                continue
            file = Path(provenance.recording_name(recording.attrs))
            position = name if len(recordings) == 1 else f"{file.stem}: {name}"
            if position in levels:
                raise ParameterError(f"{file}: microphone {position!r}: is there twice")
            signal = recording["signal"].sel(channel=name).values
            measured_db = band_levels(
                signal - signal.mean(), rate_hz, bands, REFERENCE_PRESSURE_PA, "Z"
            )
            levels[position] = np.pad(
                measured_db, (0, len(BANDS) - len(bands)), constant_values=np.nan
            )
    if not levels:
        files = ", ".join(provenance.recording_name(recording.attrs) for recording in recordings)
        raise ParameterError(f"{files}: no channel is sound pressure")
    return levels


def _by_band(area_m2: float | Mapping[float, float]) -> Array:
    by_band = area_m2 if isinstance(area_m2, Mapping) else dict.fromkeys(BAND_HZ, area_m2)
    for band in BAND_HZ:
        if band not in by_band:
            raise ParameterError(f"absorption_area_m2: has no value at {band:g} Hz")
        if not 1e-3 <= by_band[band] <= 1e6:
            raise ParameterError(
                f"absorption_area_m2 = {by_band[band]:g} m² at {band:g} Hz: must be 0.001 to "
                "1e+06 m²"
            )
    return np.array([by_band[band] for band in BAND_HZ])


def _labelled(names: list[str], levels: Array, measured: MeasuredPower) -> xr.Dataset:
    values = {
        "position_level": levels,
        "mean_position_level": measured.mean_db,
        "background_margin": measured.margin_db,
        "background_correction": measured.background_db,
        "environment_correction": measured.environment_db,
        "measured_power_level": measured.power_db,
        "measured_power_level_a": measured.power_dba,
        "background_margin_a": measured.margin_dba,
        "background_correction_a": measured.background_dba,
        "environment_correction_a": measured.environment_dba,
    }
    return stamped(values, {"channel": names, "band": BAND_HZ})
