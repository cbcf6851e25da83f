"""The machine in a room, in words and tables: how loud, by which path, what changes it."""

from typing import Final

import numpy as np
import xarray as xr

from ....base import rounding
from ....base.vocabulary import REFERENCE_OPTION
from ....results.stored_study import balancers, nearest_speed, options, overall_noise
from ...bands import band
from ...tables import Table
from ..structure_borne.tables import carrier
from ..tones.tables import NO_LOUDNESS

SONE_HEAD: Final = "Loudness, sone (diffuse field)"
_HOW: Final = (
    "Loudness by ISO 532-1 (Zwicker, diffuse field) is that of airborne and structure-borne sound "
    "together at the level in the table."
)


def has_sound_in_room(results: xr.Dataset) -> bool:
    """Whether results hold what sounds at the listeners are made of."""
    return {"room_pressure_line", "noise_band_level"} <= set(results)


def sones(results: xr.Dataset, listener: str) -> list[str]:
    """Loudness of every option at a listener; empty where it cannot be computed.

    Parameters
    ----------
    results : of a run
    listener : one of its room
    """
    if "loudness_in_room" not in results:
        return []
    here = results["loudness_in_room"].sel(speed=nearest_speed(results), listener=listener)
    return [rounding.fixed(one) for one in here.values.tolist()] if here.notnull().all() else []


def loudness_words(results: xr.Dataset) -> str:
    """How the loudness is computed, or what it needs."""
    if not has_sound_in_room(results):
        return ""
    return _HOW if "loudness_in_room" in results else NO_LOUDNESS


SEAM_DB: Final = 2.0
"""Difference of the two methods that is told."""
_LEAST_DB: Final = 0.1
_TIMES: Final = {"day": "by day", "night": "by night"}


def has_room(results: xr.Dataset) -> bool:
    """Whether the machine was put into a room."""
    return "room_level" in results


def listeners(results: xr.Dataset) -> list[str]:
    """Names of those who listen."""
    return [str(name) for name in results["listener"].values]


def loudest_listener(results: xr.Dataset) -> str:
    """The one at whom the machine without a balancer is loudest by all ways."""
    at = _at(results, REFERENCE_OPTION)
    names = listeners(results)
    return max(names, key=lambda name: _both(at.sel(listener=name)))


def room_sentence(results: xr.Dataset) -> str:
    """How loud the machine is in the room, which path carries it, which option changes that."""
    name = loudest_listener(results)
    at = _at(results, REFERENCE_OPTION).sel(listener=name)
    return (
        f"In the room the machine without a balancer is {rounding.level(_both(at))} dB(A) at "
        f"{name}, the loudest place of those asked for, at {nearest_speed(results):g} rpm"
        f"{_limit_words(results, _both(at))}: {_carrier_words(at)}{_best(results, name)}"
    )


def room_table(results: xr.Dataset, listener: str) -> Table:
    """Of every option the level by air, by the feet and both, loudness, against the limits."""
    plate = "room_plate_level" in results
    at_option = [_at(results, option).sel(listener=listener) for option in options(results)]
    loud = sones(results, listener)
    head = ["Option", "By air, dB(A)"]
    if plate:
        head += ["By the feet, dB(A)", "Both, dB(A)"]
    head += [SONE_HEAD] if loud else []
    of_words = len(head)
    head += ["Carried by"] if plate else []
    limits = _limits(results)
    head += [f"Limit {_TIMES.get(time, time)}, {limit:g} dB(A)" for time, limit in limits.items()]
    rows = []
    for number, (option, at) in enumerate(zip(options(results), at_option, strict=True)):
        here = {"option": option, "listener": listener, "speed": nearest_speed(results)}
        cells = [option, band(results, "room_level", **here).middle_and_ends(rounding.level)]
        if plate:
            cells += [_plate(at), rounding.level(_both(at))]
        cells += loud[number : number + 1]
        cells += [_carrier(at)] if plate else []
        cells += [_met(_both(at) - limit) for limit in limits.values()]
        rows.append(tuple(cells))
    caption = f"{listener}, {nearest_speed(results):g} rpm: level of the machine in the room"
    words = frozenset({0, *range(of_words, len(head))})
    return Table(caption, tuple(head), tuple(rows), words)


def seam_table(results: xr.Dataset) -> Table:
    """Waves less diffuse field of the power in the open at every listener, in third octaves."""
    bands = results["seam_band"].values
    difference = results["room_gain_difference"]
    rows = tuple(
        (name, *(rounding.signed(float(one)) for one in difference.sel(listener=name).values))
        for name in listeners(results)
    )
    head = ("Listener", *(f"{band:g} Hz" for band in bands))
    gain = results["room_place_gain"].values
    gains = ("mean, for the gain of the place", *(rounding.signed(float(one)) for one in gain))
    return Table("Waves less diffuse field of the power in the open, dB", head, (*rows, gains))


def seam_sentence(results: xr.Dataset) -> str:
    """Where the two methods differ by more than is to be passed over, and what follows of it."""
    difference, gain = results["room_gain_difference"], results["room_place_gain"]
    on_average = [
        f"{band:g} Hz ({rounding.signed(float(gain.sel(seam_band=band)))} dB)"
        for band in gain["seam_band"].values
        if abs(float(gain.sel(seam_band=band))) > SEAM_DB
    ]
    alone = [
        f"{name} {band:g} Hz ({rounding.signed(float(value))} dB)"
        for name in listeners(results)
        for band, value in zip(
            gain["seam_band"].values, (difference - gain).sel(listener=name).values, strict=True
        )
        if abs(value) > SEAM_DB
    ]
    above = rounding.signed(float(results["room_place_gain_above"]))
    none = "no third octave"
    return (
        "Waves and the diffuse field of the power in the open differ by more than "
        f"{SEAM_DB:g} dB, in the mean over {len(listeners(results))} listeners, at "
        f"{', '.join(on_average) or none}. The mean is taken for what the place does "
        f"to the machine's power and given to the diffuse field; above the waves {above} dB, "
        "where single third octaves may be 5 dB off (assumed). "
        f"From that mean single listeners differ by more at {', '.join(alone) or none}."
    )


def absorption(results: xr.Dataset) -> list[Table]:
    """Return requested and computed absorption by octave; results of earlier versions have none.

    Surfaces that are alike have one row.
    """
    if "room_wall_absorption" not in results:
        return []
    rows: dict[tuple[str, ...], list[str]] = {}
    for surface in results["room_surface"].values:
        at = results.sel(room_surface=surface)
        cells = zip(
            at["room_wall_absorption_requested"].values,
            at["room_wall_absorption"].values,
            strict=True,
        )
        row = tuple(f"{one:.2f} → {_absorption(in_waves)}" for one, in_waves in cells)
        rows.setdefault(row, []).append(str(surface).partition(".")[2])
    head = ("Surfaces", *(f"{octave:g} Hz" for octave in results["room_octave"].values))
    caption = "Absorption at random incidence by octave: requested → in the waves"
    return [Table(caption, head, tuple((", ".join(names), *row) for row, names in rows.items()))]


def _absorption(ratio: float) -> str:
    return rounding.NOTHING if np.isnan(ratio) else f"{ratio:.2f}"


def power_sentence(results: xr.Dataset) -> str:
    """Sound power in the open, the same machine at its published point, and the room's gain."""
    at = _at(results, REFERENCE_OPTION)
    name = loudest_listener(results)
    by_air = at.sel(listener=name)
    power = float(
        results["room_sound_power_level"].sel(speed=nearest_speed(results), option=REFERENCE_OPTION)
    )
    return (
        f"On a hard floor in the open the machine has a sound power level of "
        f"{rounding.level(power)} dB(A) re 1 pW, nominal; {_published(results)}. "
        f"Airborne it is {rounding.level(float(by_air['room_level']))} dB(A) at {name}."
    )


def _published(results: xr.Dataset) -> str:
    published = overall_noise(results)
    if published is None:
        return "no level is published"
    return (
        f"its noise is published as {published['level_dba']:g} dB(A) at "
        f"{published['distance_m']:g} m and {published['speed_rpm']:g} rpm"
    )


def _at(results: xr.Dataset, option: str) -> xr.Dataset:
    names = [
        name
        for name in results.data_vars
        if {"listener", "option"} <= set(results[name].dims) and results[name].ndim == 3
    ]
    return results[names].sel(speed=nearest_speed(results), option=option)


def _both(at: xr.Dataset) -> float:
    return float(at["room_level_both_ways"]) if "room_level_both_ways" in at else _by_air(at)


def _by_air(at: xr.Dataset) -> float:
    return float(at["room_level"])


def _carrier(at: xr.Dataset) -> str:
    low, high = (float(at[f"room_plate_level_{end}"]) for end in ("low", "high"))
    which = carrier(_by_air(at), low, high)
    return "the feet" if which == "the plate" else which


def _carrier_words(at: xr.Dataset) -> str:
    if "room_plate_level" not in at:
        return f"it comes by air, {rounding.level(float(at['room_level']))} dB(A)"
    which = _carrier(at)
    verdict = "which carries it is not sure" if which == "not sure" else f"{which} carries it"
    return (
        f"by air {rounding.level(float(at['room_level']))} dB(A), by the feet and the plate "
        f"{_plate(at)} dB(A); {verdict}"
    )


def _best(results: xr.Dataset, listener: str) -> str:
    each = {one: _both(_at(results, one).sel(listener=listener)) for one in balancers(results)}
    given = _both(_at(results, REFERENCE_OPTION).sel(listener=listener))
    if not each:
        return "."
    least = min(each, key=lambda option: each[option])
    if each[least] > given - _LEAST_DB:
        return "; no option changes that."
    return f"; {least} takes most off it, {rounding.signed(each[least] - given)} dB."


def _limits(results: xr.Dataset) -> dict[str, float]:
    if "room_limit" not in results:
        return {}
    limit = results["room_limit"]
    return {
        str(time): float(limit.sel(room_limit_time=time)) for time in limit.room_limit_time.values
    }


def _limit_words(results: xr.Dataset, level: float) -> str:
    words = [
        f"{rounding.fixed(abs(level - limit))} dB {'over' if level > limit else 'under'} the limit "
        f"{_TIMES.get(time, time)}"
        for time, limit in _limits(results).items()
    ]
    return f", {' and '.join(words)}" if words else ""


def _met(over_db: float) -> str:
    return "met" if over_db <= 0.0 else f"missed by {rounding.fixed(over_db)} dB"


def _plate(at: xr.Dataset) -> str:
    """Structure-borne level with what its method leaves open."""
    level, low, high = (
        rounding.level(float(at[f"room_plate_level{end}"])) for end in ("", "_low", "_high")
    )
    silent = float(at["room_plate_level"]) < rounding.LEVEL_FLOOR_DB
    return level if silent else f"{level} ({low} to {high})"
