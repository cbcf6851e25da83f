"""Section on the room: level at listeners, by which path, and what changes it."""

from typing import Final

import numpy as np
import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import band
from ...results.estimates import estimate
from ...results.stored_study import balancers, nearest_speed, options, overall_noise
from ..blocks import Block, Details, Pictures, Text
from ..figures.in_room import room_map, room_seam
from ..tables import DataTable, Table, long_table
from . import Section, hold
from .structure_borne import UNCERTAIN, carrier, ranged
from .tones import NO_LOUDNESS

SONE_HEAD: Final = "Loudness, sone (diffuse field)"
CROSSOVER_DB: Final = 2.0
"""Difference of the two methods that is reported."""
_HOW: Final = (
    "Loudness by ISO 532-1 (Zwicker, diffuse field) is that of airborne and structure-borne sound "
    "together at the level in the table."
)
_LEAST_DB: Final = 0.1
_TIMES: Final = {"day": "by day", "night": "by night"}
_DATA: Final = ("room_level", "room_plate_level", "room_loudness", "room_sharpness")


def _blocks(results: xr.Dataset) -> list[Block]:
    loudest = loudest_listener(results)
    return [
        Text(room_sentence(results), "strong"),
        room_table(results, loudest),
        Text(power_sentence(results)),
        Text(crossover_sentence(results)),
        Pictures((room_map(results), room_seam(results, loudest))),
        Details("Both methods at every listener", (crossover_table(results),)),
        *(Details("Absorption of walls and furniture", (table,)) for table in absorption(results)),
        Text(
            "Below the crossover frequency sound is a wave field, above it direct sound and the "
            "diffuse field of the sound power. Unmodelled noise is radiated equally in all "
            "directions from the machine's axis; the plate by its mean power beside a foot "
            "(assumed). Intervals are those at the published microphone. "
            f"{_loudness_words(results)} Other listeners and speeds are in room.csv.",
            "note",
        ),
    ]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = [name for name in map(str, results.data_vars) if name.startswith(_DATA)]
    return {"room.csv": long_table(results, names)}


def sones(results: xr.Dataset, listener: str) -> list[str]:
    """Loudness of every option at a listener; empty where it cannot be computed."""
    if "loudness_in_room" not in results:
        return []
    here = results["loudness_in_room"].sel(speed=nearest_speed(results), listener=listener)
    return [rounding.fixed(value) for value in here.values.tolist()] if here.notnull().all() else []


def _loudness_words(results: xr.Dataset) -> str:
    """Words on how the loudness is computed, or what it needs."""
    if not hold("room_pressure_line", "noise_band_level")(results):
        return ""
    return _HOW if "loudness_in_room" in results else NO_LOUDNESS


def listeners(results: xr.Dataset) -> list[str]:
    """Names of those who listen."""
    return [str(name) for name in results["listener"].values]


def loudest_listener(results: xr.Dataset) -> str:
    """The one at whom the machine without a balancer is loudest by all ways."""
    return max(listeners(results), key=lambda name: _both(results, name))


def room_sentence(results: xr.Dataset) -> str:
    """Say how loud the machine is in the room, which path dominates, which option changes it."""
    name = loudest_listener(results)
    level = _both(results, name)
    limits = [
        f"{rounding.fixed(abs(level - limit))} dB {'over' if level > limit else 'under'} the limit "
        f"{_TIMES.get(time, time)}"
        for time, limit in _limits(results).items()
    ]
    beside = f" That is {' and '.join(limits)}." if limits else ""
    return (
        f"In the room the machine without a balancer is {rounding.level(level)} dB(A) at "
        f"{name}, the loudest listener, at {nearest_speed(results):g} rpm.{beside} "
        f"{_carrier_words(results, name)}{_best(results, name)}"
    )


def room_table(results: xr.Dataset, listener: str) -> Table:
    """Return the levels of every option, airborne, structure-borne and both, loudness, and the
    limits."""
    plate = "room_plate_level" in results
    loud, limits = sones(results, listener), _limits(results)
    head = ["Option", "By air, dB(A)"]
    head += ["By the feet, dB(A)", "Both, dB(A)"] if plate else []
    head += [SONE_HEAD] if loud else []
    of_words = len(head)
    head += ["Carried by"] if plate else []
    head += [f"Limit {_TIMES.get(time, time)}, {limit:g} dB(A)" for time, limit in limits.items()]
    rows = []
    for number, option in enumerate(options(results)):
        here = {"option": option, "listener": listener, "speed": nearest_speed(results)}
        total = _both(results, listener, option)
        cells = [option, band(results, "room_level", **here).middle_and_ends(rounding.level)]
        cells += [_plate(results, listener, option), rounding.level(total)] if plate else []
        cells += loud[number : number + 1]
        cells += [_carrier(results, listener, option)] if plate else []
        over_db = [total - limit for limit in limits.values()]
        cells += ["met" if db <= 0.0 else f"missed by {rounding.fixed(db)} dB" for db in over_db]
        rows.append(tuple(cells))
    caption = f"{listener}, {nearest_speed(results):g} rpm: level of the machine in the room"
    words = frozenset({0, *range(of_words, len(head))})
    return Table(caption, tuple(head), tuple(rows), words)


def crossover_table(results: xr.Dataset) -> Table:
    """Waves less diffuse field of the power in the open at every listener, in third octaves."""
    difference = results["room_gain_difference"].transpose("listener", "seam_band").values
    named = dict(zip(listeners(results), difference, strict=True))
    named["mean, gain of the position"] = results["room_place_gain"].values
    rows = tuple((name, *map(rounding.signed, row.tolist())) for name, row in named.items())
    head = ("Listener", *(f"{band:g} Hz" for band in results["seam_band"].values))
    return Table("Waves less diffuse field of the power in the open, dB", head, rows)


def crossover_sentence(results: xr.Dataset) -> str:
    """Say in which third octaves the two methods differ, and how the difference is used."""
    gain = results["room_place_gain"]
    alone = (results["room_gain_difference"] - gain).transpose("listener", "seam_band")
    at_one = [
        f"{name} {third_octave}"
        for name, values in zip(listeners(results), alone, strict=True)
        for third_octave in _large_differences(values)
    ]
    above = rounding.signed(float(results["room_place_gain_above"]))
    none = "no third octave"
    return (
        "Waves and the diffuse field of the power in the open differ by more than "
        f"{CROSSOVER_DB:g} dB, in the mean over {len(listeners(results))} listeners, at "
        f"{', '.join(_large_differences(gain)) or none}. This mean is the gain of the machine's "
        "position and corrects the diffuse field. "
        f"Above the waves the gain is {above} dB; single third octaves may be 5 dB off (assumed). "
        "Single listeners differ from the mean by more than "
        f"{CROSSOVER_DB:g} dB at {', '.join(at_one) or none}."
    )


def _large_differences(gain: xr.DataArray) -> list[str]:
    """Third octaves where a difference over them, dB, counts."""
    pairs = zip(gain["seam_band"].values.tolist(), gain.values.tolist(), strict=True)
    return [f"{hz:g} Hz ({rounding.signed(db)} dB)" for hz, db in pairs if abs(db) > CROSSOVER_DB]


def absorption(results: xr.Dataset) -> list[Table]:
    """Return requested and computed absorption by octave; results of earlier versions have none.

    Surfaces that are alike have one row.
    """
    if "room_wall_absorption" not in results:
        return []
    rows: dict[tuple[str, ...], list[str]] = {}
    for surface in results["room_surface"].values:
        requested, in_waves = (
            results[f"room_wall_absorption{end}"].sel(room_surface=surface).values.tolist()
            for end in ("_requested", "")
        )
        row = tuple(
            f"{wanted:.2f} → {rounding.NOTHING if np.isnan(other) else f'{other:.2f}'}"
            for wanted, other in zip(requested, in_waves, strict=True)
        )
        rows.setdefault(row, []).append(str(surface).partition(".")[2])
    head = ("Surfaces", *(f"{octave:g} Hz" for octave in results["room_octave"].values))
    caption = "Absorption at random incidence by octave: requested → in the waves"
    return [Table(caption, head, tuple((", ".join(names), *row) for row, names in rows.items()))]


def power_sentence(results: xr.Dataset) -> str:
    """Sound power in the open, the same machine at its published point, and the room's gain."""
    name = loudest_listener(results)
    published = overall_noise(results)
    noise = (
        "No level is published"
        if published is None
        else f"The published level is {published['level_dba']:g} dB(A) at "
        f"{published['distance_m']:g} m and {published['speed_rpm']:g} rpm"
    )
    return (
        "On a hard floor in the open the machine has a sound power level of "
        f"{_level(results, 'room_sound_power_level', name)} dB(A) re 1 pW, nominal. {noise}. "
        f"Airborne sound in the room is {_level(results, 'room_level', name)} dB(A) at {name}."
    )


def _value(results: xr.Dataset, name: str, listener: str, option: str = REFERENCE_OPTION) -> float:
    coordinates = {"option": option, "listener": listener, "speed": nearest_speed(results)}
    return estimate(results, name, **coordinates).value


def _level(results: xr.Dataset, name: str, listener: str, option: str = REFERENCE_OPTION) -> str:
    return rounding.level(_value(results, name, listener, option))


def _both(results: xr.Dataset, listener: str, option: str = REFERENCE_OPTION) -> float:
    name = "room_level_both_ways" if "room_level_both_ways" in results else "room_level"
    return _value(results, name, listener, option)


def _carrier(results: xr.Dataset, listener: str, option: str = REFERENCE_OPTION) -> str:
    names = ("room_level", "room_plate_level_low", "room_plate_level_high")
    return carrier(*(_value(results, name, listener, option) for name in names))


def _carrier_words(results: xr.Dataset, listener: str) -> str:
    level = _level(results, "room_level", listener)
    if "room_plate_level" not in results:
        return f"All of it is airborne, {level} dB(A)."
    which = _carrier(results, listener)
    verdict = "it is uncertain which dominates" if which == UNCERTAIN else f"{which} dominates"
    plate = _plate(results, listener)
    return f"Airborne {level} dB(A), structure-borne {plate} dB(A): {verdict}."


def _best(results: xr.Dataset, listener: str) -> str:
    each = {option: _both(results, listener, option) for option in balancers(results)}
    if not each:
        return ""
    least = min(each, key=lambda option: each[option])
    change = each[least] - _both(results, listener)
    if change > -_LEAST_DB:
        return f" No option lowers it by {_LEAST_DB:g} dB or more."
    return f" Option {least} lowers it most, {rounding.signed(change)} dB."


def _limits(results: xr.Dataset) -> dict[str, float]:
    if "room_limit" not in results:
        return {}
    limit = results["room_limit"]
    times = map(str, limit["room_limit_time"].values)
    return dict(zip(times, limit.values.tolist(), strict=True))


def _plate(results: xr.Dataset, listener: str, option: str = REFERENCE_OPTION) -> str:
    names = (f"room_plate_level{end}" for end in ("", "_low", "_high"))
    return ranged(*(_value(results, name, listener, option) for name in names))


register(Section("in-room", "In the room", _blocks, hold("room_level"), 33.5, tables=_data))
