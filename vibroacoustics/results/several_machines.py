"""Results of several machines at common receivers: lines, levels, beats, the base frame."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import amplitude_of_level, energy_sum, mean_square_level, sound_pressure_level
from ..base.vocabulary import AXES, HIGH, LOW, SUFFIXES, check, label_coordinates, stamped
from ..base.weighting import WEIGHTING
from ..levels.bands import Band
from ..levels.beats import (
    Beat,
    MachineLine,
    beats,
    envelope_maximum,
    envelope_minimum,
    groups,
)
from ..mechanics.added import third_octave_number
from ..sound.ingredients import Ingredients, SoundBands, SoundLines
from ..sound.on_base_frame import FrameSound, Lined, MachineRun, on_base_frame
from ..sound.together import line_name, machine_line, together
from ..study.study import Study
from .estimates import estimate, is_sampled
from .provenance import attributes

_AT_1_KHZ: Final = 30
_PARTS: Final = ("first", "second")
_Sounds = dict[str, dict[str, Ingredients]]
"""Sounds by common receiver, then by machine."""


def results_together(study: Study, runs: Mapping[str, MachineRun]) -> xr.Dataset:
    """Combine the runs of several machines at their common receivers.

    Parameters
    ----------
    study : with tables of several machines
    runs : runs of the machines, by name
    """
    frame = on_base_frame(study, runs)
    on_floor = {
        receiver: {name: run.sound(receiver) for name, run in runs.items()}
        for receiver in study.common_receivers
    }
    sounds = on_floor if frame is None else _on_frame(frame, on_floor)
    lines = _machine_lines(sounds)
    results = _levels(runs, sounds, on_floor, lines).merge(_lines(sounds, lines))
    results = results.merge(_beats(sounds, lines))
    if frame is not None:
        results = results.merge(_of_frame(frame, list(results["machine_line"].values)))
    results.attrs = attributes(study)
    return label_coordinates(check(results))


def sound_of(results: xr.Dataset, receiver: str) -> Ingredients:
    """Return lines and noise of several machines at a common receiver.

    Parameters
    ----------
    results : result of `results_together`
    receiver : one of its common receivers
    """
    received = results.sel(common_receiver=receiver)
    lines = SoundLines(
        received["machine_line_frequency"].values,
        received["machines_pressure_line"].values,
        tuple(map(str, received["machine_line"].values)),
    )
    numbers = third_octave_number(received["machine_noise_band"].values).tolist()
    centres = np.array([Band(3, int(number) - _AT_1_KHZ).middle_hz for number in numbers])
    level_db = received["machines_noise_band_level"].values
    noise = SoundBands(centres, REFERENCE_PRESSURE_PA * amplitude_of_level(level_db))
    return Ingredients(lines, noise)


def _on_frame(frame: FrameSound, on_floor: _Sounds) -> _Sounds:
    """Sounds with the lines that all housings on the frame radiate."""
    sounds: _Sounds = {receiver: {} for receiver in on_floor}
    for name, run in frame.runs.items():
        lined: dict[str, Lined] = {}
        for receiver, parts in on_floor.items():
            lines = parts[name].lines
            lined[receiver] = dict(zip(lines.name, lines.pressure_pa.tolist(), strict=True))
        hertz = dict(zip(run.lines.names, run.lines.frequency_hz.tolist(), strict=True))
        for receiver, changed in frame.lines(name, lined).items():
            before = on_floor[receiver][name]
            hertz |= dict(zip(before.lines.name, before.lines.frequency_hz.tolist(), strict=True))
            sounds[receiver][name] = replace(before, lines=_rising(changed, hertz))
    return sounds


def _rising(lined: Lined, frequency_hz: Mapping[str, float]) -> SoundLines:
    names = sorted(lined, key=lambda name: frequency_hz[name])
    hertz = np.array([frequency_hz[name] for name in names])
    return SoundLines(hertz, np.array([lined[name] for name in names]), tuple(names))


def _machine_lines(sounds: _Sounds) -> dict[str, MachineLine]:
    """Lines that sound at any receiver, by name, rising in frequency."""
    hertz: dict[str, float] = {}
    machines = list(next(iter(sounds.values())))
    for parts in sounds.values():
        joined = together(parts).lines
        hertz |= dict(zip(joined.name, joined.frequency_hz.tolist(), strict=True))
    names = sorted(hertz, key=lambda name: hertz[name])
    return {name: machine_line(name, hertz[name], machines) for name in names}


def _pressure(sound: Ingredients, names: Sequence[str]) -> ComplexArray:
    peaks = dict(zip(sound.lines.name, sound.lines.pressure_pa.tolist(), strict=True))
    return np.array([peaks.get(name, 0.0) for name in names], dtype=complex)


def _levels(
    runs: Mapping[str, MachineRun],
    sounds: _Sounds,
    on_floor: _Sounds,
    lines: Mapping[str, MachineLine],
) -> xr.Dataset:
    """Levels of each machine, the sum of their energies, and every beat at its maximum."""
    values: dict[str, Any] = {"machine_speed": [run.key[0] for run in runs.values()]}
    rise_db = np.array([_rise_db(together(parts), lines) for parts in sounds.values()])
    for part, suffix in {"value": "", "low": SUFFIXES[LOW], "high": SUFFIXES[HIGH]}.items():
        if suffix and not all(is_sampled(run.results, "level_total") for run in runs.values()):
            continue
        of_machines = np.array(
            [
                [
                    getattr(_of_machine(run, receiver), part)
                    + parts[name].a_weighted_db
                    - on_floor[receiver][name].a_weighted_db
                    for name, run in runs.items()
                ]
                for receiver, parts in sounds.items()
            ]
        )
        total = energy_sum(of_machines, axis=1)
        values[f"machine_level{suffix}"] = of_machines
        values[f"machines_level{suffix}"] = total
        values[f"machines_highest_level{suffix}"] = total + rise_db
    return stamped(values, {"machine": list(runs), "common_receiver": list(sounds)})


def _of_machine(run: MachineRun, receiver: str) -> Any:
    speed_rpm, option = run.key
    labels = {"speed": speed_rpm, "option": option, "receiver": receiver}
    return estimate(run.results, "level_total", **labels)


def _rise_db(sound: Ingredients, lines: Mapping[str, MachineLine]) -> float:
    """A-weighted level with every beat at its maximum over that of the energies, dB."""
    names = list(lines)
    hertz = np.array([line.frequency_hz for line in lines.values()])
    weighted = _pressure(sound, names) * amplitude_of_level(WEIGHTING["A"](hertz))
    at_maximum = [
        envelope_maximum(weighted[group])
        for group in groups(len(names), beats(list(lines.values())))
    ]
    silent = SoundLines(np.zeros(0), np.zeros(0, complex), ())
    noise_db = Ingredients(silent, sound.bands).a_weighted_db
    each = [*sound_pressure_level(np.array(at_maximum)), noise_db]
    return float(energy_sum(np.array(each), axis=0)) - sound.a_weighted_db


def _lines(sounds: _Sounds, lines: Mapping[str, MachineLine]) -> xr.Dataset:
    """Lines and noise of all machines together."""
    joined = [together(parts) for parts in sounds.values()]
    bands = sorted({hertz for sound in joined for hertz in sound.bands.centre_hz.tolist()})
    square = np.zeros((len(joined), len(bands)))
    for row, sound in enumerate(joined):
        columns = [bands.index(hertz) for hertz in sound.bands.centre_hz.tolist()]
        square[row, columns] = sound.bands.pressure_pa**2
    nominal = [
        Band(3, int(number) - _AT_1_KHZ).nominal_hz
        for number in third_octave_number(np.array(bands)).tolist()
    ]
    names = list(lines)
    values = {
        "machines_pressure_line": [_pressure(sound, names) for sound in joined],
        "machines_noise_band_level": mean_square_level(square, REFERENCE_PRESSURE_PA),
    }
    coords = {
        "common_receiver": list(sounds), "machine_line": names, "machine_noise_band": nominal,
    }  # fmt: skip
    hertz = [line.frequency_hz for line in lines.values()]
    return stamped(values, coords).assign_coords(machine_line_frequency=("machine_line", hertz))


def _beats(sounds: _Sounds, lines: Mapping[str, MachineLine]) -> xr.Dataset:
    """Levels of all pairs of orders that beat; empty where there are none."""
    names, pairs = list(lines), beats(list(lines.values()))
    if not pairs:
        return xr.Dataset()
    pressure = np.array([_pressure(together(parts), names) for parts in sounds.values()])
    of_pairs = np.stack([pressure[:, [pair.first, pair.second]] for pair in pairs], axis=1)
    square = 0.5 * (np.abs(of_pairs) ** 2).sum(axis=-1)
    values = {
        "beat_line_level": sound_pressure_level(of_pairs),
        "beat_energy_level": mean_square_level(square, REFERENCE_PRESSURE_PA),
        "beat_highest_level": sound_pressure_level(envelope_maximum(of_pairs, axis=-1)),
        "beat_lowest_level": sound_pressure_level(envelope_minimum(of_pairs, axis=-1)),
    }
    coords = {
        "common_receiver": list(sounds),
        "beat": [_beat_name(names, pair) for pair in pairs],
        "beat_part": list(_PARTS),
    }
    hertz = [pair.frequency_hz for pair in pairs]
    return stamped(values, coords).assign_coords(beat_frequency=("beat", hertz))


def _beat_name(names: Sequence[str], pair: Beat) -> str:
    return f"{names[pair.first]}, {names[pair.second]}"


def _of_frame(frame: FrameSound, names: Sequence[str]) -> xr.Dataset:
    """Natural frequencies of all bodies on the frame, and its force on the floor by line."""
    machines = frame.frame
    feet = list(machines.mounts.names)
    force: ComplexArray = np.zeros((len(feet), len(AXES), len(names)), dtype=complex)
    for name in frame.runs:
        lines, motion = frame.driven_by(name)
        at_feet = machines.floor_force(motion, lines.frequency_hz)
        for row, line in enumerate(lines.names):
            if (column := line_name(name, line)) in names:
                force[:, :, names.index(column)] = at_feet[row]
    natural_hz: Array = machines.isolation.natural_modes()[0]
    modes = [f"mode_{number}" for number in range(1, natural_hz.size + 1)]
    coords = {
        "base_mode": modes, "base_foot": feet, "axis": list(AXES), "machine_line": list(names),
    }  # fmt: skip
    values = {"base_natural_frequency": natural_hz, "base_floor_force": force}
    return stamped(values, coords)
