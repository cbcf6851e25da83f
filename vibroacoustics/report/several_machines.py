"""Analysis of several machines that run at the same time: levels, beats, the base frame."""

from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np
import xarray as xr

from ..base import rounding
from ..base.vocabulary import HIGH, LOW, SUFFIXES
from ..results.estimates import Estimate, is_sampled
from ..results.number import Number, number
from ..results.stored_study import parameters
from .analysis import Analysis, origin
from .blocks import Block, Bullets, Part, Pictures, Sound, Sounds, Text
from .figures.beats import beat_charts
from .tables import Cell, DataTable, Table, data_table, phase_deg

_LIMITS: Final = (
    "The levels of the machines add by their energies: lines at their own frequencies and noise "
    "are incoherent. The ends of the 80 % interval add alike, as if all machines were at the same "
    "end: the interval of independent machines is narrower.",
    "At the maximum of a beat the pressures of its lines add, |p1| + |p2|. Where both frequencies "
    "are equal, as of two motors on one mains, this is the worst relative phase, which stays.",
    "The maxima of all beats rarely coincide. The highest level is an upper bound.",
    "Neglected: sound that one machine reflects or shields from another, and sound that the base "
    "frame radiates.",
    "On a base frame each line is computed with one matrix of all bodies. Noise and the rating of "
    "each machine alone are those on a rigid floor.",
)


def analysis_of_machines(results: xr.Dataset, sounds: Mapping[str, str]) -> Analysis:
    """Return levels and beats of several machines, with the sound at each common receiver.

    Parameters
    ----------
    results : results of all machines together, the root of the tree of `run_machines`
    sounds : files beside the page by common receiver
    """
    levels = _levels(results)
    players = Sounds(tuple(Sound(receiver, file) for receiver, file in sounds.items()))
    parts = [Part("levels", "Levels", (levels, players))]
    tables = {"machines.csv": _level_data(results), "machine_lines.csv": _line_data(results)}
    shown: list[Block] = [levels]
    if "beat_energy_level" in results:
        first, *others = (_beats(results, name) for name in _receivers(results))
        parts.append(Part("beats", "Beats", (Pictures(tuple(beat_charts(results))), first)))
        if others:
            parts.append(Part("more_beats", "Beats at other microphones", tuple(others), True))
        tables["beats.csv"] = _beat_data(results)
        shown.append(first)
    if "base_natural_frequency" in results:
        frame = _frame(results)
        parts.append(Part("frame", "Base frame", frame))
        tables["base_frame.csv"] = _frame_data(results)
        shown += frame
    coarse = tuple(f"Coarse run: {words}." for words in parameters(results).get("coarsened", ()))
    limits = Bullets((*coarse, *_LIMITS))
    parts.append(Part("limits", "Assumptions and limits", (limits,), not coarse))
    return Analysis(
        "machines",
        about="Several machines that run at the same time.",
        parts=tuple(parts),
        summary=tuple(_sentences(results)),
        shown=tuple(shown),
        tables=tables,
        **origin(results, "Machines"),
    )


def _receivers(results: xr.Dataset) -> list[str]:
    return [str(name) for name in results["common_receiver"].values]


def _sentences(results: xr.Dataset) -> Iterator[str]:
    receiver = _receivers(results)[0]
    names = [str(name) for name in results["machine"].values]
    of_machines = ", ".join(
        f"{name} at {rpm:g} rpm "
        f"{_level(results, 'machine_level', common_receiver=receiver, machine=name)}"
        for name, rpm in zip(names, results["machine_speed"].values, strict=True)
    )
    total = _level(results, "machines_level", common_receiver=receiver)
    yield f"Together at {receiver}: {total} dB(A); alone {of_machines}."
    if "beat_energy_level" in results:
        yield _strongest_beat(results)
    highest, mean = (
        results[name].sel(common_receiver=receiver).item()
        for name in ("machines_highest_level", "machines_level")
    )
    rise = rounding.fixed(highest - mean)
    yield f"With every beat at its maximum the level at {receiver} is {rise} dB higher."
    if "base_natural_frequency" in results:
        hertz = results["base_natural_frequency"].values
        low, high = (rounding.three_digits(end) for end in (hertz[0], hertz[-1]))
        yield f"The machines on the base frame have natural frequencies from {low} to {high} Hz."


def _strongest_beat(results: xr.Dataset) -> str:
    """Return a sentence on the beat with the highest maximum."""
    loudest = results["beat_highest_level"].stack(pair=("common_receiver", "beat"))
    pair = loudest.isel(pair=int(np.argmax(loudest.values)))
    receiver, beat = str(pair["common_receiver"].item()), str(pair["beat"].item())
    labels = {"common_receiver": receiver, "beat": beat}
    highest, lowest = (
        rounding.level(results[f"beat_{end}_level"].sel(labels).item())
        for end in ("highest", "lowest")
    )
    hertz = results["beat_frequency"].sel(beat=beat).item()
    how = f"beat at {rounding.three_digits(hertz)} Hz" if hertz else "have one frequency"
    return f"Strongest beat, at {receiver}: {beat} {how}, {lowest} to {highest} dB unweighted."


def _level(results: xr.Dataset, variable: str, **labels: str) -> Number:
    return number(results, variable, _with_ends, "dB(A)", **labels)


def _with_ends(level: Estimate) -> str:
    if level.low == level.high:
        return rounding.fixed(level.value)
    ends = (rounding.fixed(end, 0) for end in (level.low, level.high))
    return f"{rounding.fixed(level.value)} ({' to '.join(ends)})"


def _levels(results: xr.Dataset) -> Table:
    names = [str(name) for name in results["machine"].values]
    rows: list[tuple[Cell, ...]] = []
    for receiver in _receivers(results):
        alone = (_level(results, "machine_level", common_receiver=receiver, machine=name)
                 for name in names)  # fmt: skip
        total = (_level(results, name, common_receiver=receiver)
                for name in ("machines_level", "machines_highest_level"))  # fmt: skip
        rows.append((receiver, *alone, *total))
    head = ("Microphone", *names, "together", "beats at maximum")
    interval = "; 80 % interval in brackets" if is_sampled(results, "machines_level") else ""
    return Table(f"A-weighted levels, dB re 20 µPa{interval}", head, tuple(rows))


def _beats(results: xr.Dataset, receiver: str) -> Table:
    heads = ("energy", "highest", "lowest")
    rows = []
    for beat, hertz in zip(results["beat"].values, results["beat_frequency"].values, strict=True):
        of_beat = results.sel(common_receiver=receiver, beat=beat)
        lines = of_beat["beat_line_level"].values.tolist()
        others = (of_beat[f"beat_{name}_level"].item() for name in heads)
        levels = (rounding.level(value) for value in (*lines, *others))
        rows.append((str(beat), rounding.fixed(float(hertz), 3), *levels))
    head = ("Lines", "beat, Hz", "first", "second", "energies", "maximum", "minimum")
    return Table(f"Beats at {receiver}: unweighted levels, dB re 20 µPa", head, tuple(rows))


def _frame(results: xr.Dataset) -> tuple[Block, ...]:
    """Natural frequencies, and the forces of the frame's feet at the first orders."""
    hertz = results["base_natural_frequency"].values
    words = ", ".join(rounding.three_digits(value) for value in hertz)
    force = _size(results["base_floor_force"]).max("axis")
    firsts = [
        name for name in map(str, results["machine_line"].values) if name.endswith(": order 1")
    ]
    rows = [
        (str(foot), *(rounding.three_digits(force.sel(base_foot=foot, machine_line=line).item())
                      for line in firsts))
        for foot in results["base_foot"].values
    ]  # fmt: skip
    table = Table("Largest force on the floor at order 1, N", ("Foot", *firsts), tuple(rows))
    return Text(f"Natural frequencies: {words} Hz."), table


def _level_data(results: xr.Dataset) -> DataTable:
    columns = {
        "microphone": results["common_receiver"], "machine": results["machine"],
        "speed_rpm": results["machine_speed"],
    }  # fmt: skip
    for variable, head in (
        ("machine_level", "level"),
        ("machines_level", "level_together"),
        ("machines_highest_level", "level_highest"),
    ):
        for suffix in ("", SUFFIXES[LOW], SUFFIXES[HIGH]):
            if f"{variable}{suffix}" in results:
                columns[f"{head}{suffix}_dba"] = results[f"{variable}{suffix}"]
    return data_table(("common_receiver", "machine"), columns)


def _beat_data(results: xr.Dataset) -> DataTable:
    parts = {
        f"{part}_level_db": results["beat_line_level"].sel(beat_part=part, drop=True)
        for part in map(str, results["beat_part"].values)
    }
    return data_table(
        ("common_receiver", "beat"),
        {
            "microphone": results["common_receiver"],
            "lines": results["beat"],
            "beat_hz": results["beat_frequency"],
            **parts,
            "energy_level_db": results["beat_energy_level"],
            "highest_level_db": results["beat_highest_level"],
            "lowest_level_db": results["beat_lowest_level"],
        },
    )


def _line_data(results: xr.Dataset) -> DataTable:
    pressure = results["machines_pressure_line"]
    return data_table(
        ("common_receiver", "machine_line"),
        {
            "microphone": results["common_receiver"],
            "line": results["machine_line"],
            "frequency_hz": results["machine_line_frequency"],
            "pressure_peak_pa": _size(pressure),
            "phase_deg": phase_deg(pressure),
        },
    )


def _frame_data(results: xr.Dataset) -> DataTable:
    force = results["base_floor_force"]
    return data_table(
        ("base_foot", "axis", "machine_line"),
        {
            "foot": results["base_foot"],
            "axis": results["axis"],
            "line": results["machine_line"],
            "frequency_hz": results["machine_line_frequency"],
            "force_peak_n": _size(force),
            "phase_deg": phase_deg(force),
        },
    )


def _size(peaks: xr.DataArray) -> xr.DataArray:
    return peaks.copy(data=np.abs(peaks.values))
