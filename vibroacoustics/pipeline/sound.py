"""Sound of all sources at the receivers, as given and with every draw."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from itertools import product
from typing import Final

import numpy as np
import xarray as xr

from .. import levels
from ..base.arrays import Array, ComplexArray
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.errors import ParameterError, SolverError
from ..base.progress import Progress
from ..base.vocabulary import (
    REFERENCE_OPTION,
    WEIGHTINGS,
    check,
    stamp,
)
from ..levels.by_source import NoisePower, SourceSound, source_sound
from ..levels.insertion_loss import remaining_share
from ..machine.shell_structure import JOINTS, ShellStructure, ShellVariation
from ..machine.source import Case
from ..mechanics.loads import Lines, Loads, lines_of
from ..radiation.machine_side import processors
from ..radiation.pressure import (
    pressure_per_shell_velocity,
    pressure_per_velocity,
    wrench_pressure,
)
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.path import ShellPath
from ..transfer.sound_path import BendingShell, PressurePerVelocity, SoundPath
from ..uncertainty.draws import AS_GIVEN, Draw, latin_hypercube, with_draw
from .cases import At, loads_of, with_values
from .motion import Motion, at_speeds, motion_of

A_FIRST = tuple(sorted(WEIGHTINGS, key=lambda name: name != "A"))
"""Weightings of the totals."""


@dataclass(frozen=True)
class CaseSound:
    """Sound of one case.

    Attributes
    ----------
    lines : of all sources
    pressure : complex peaks, shape (source, receiver, line), Pa
    by_source : its mean squares
    """

    lines: Lines
    pressure: ComplexArray
    by_source: SourceSound


@dataclass(frozen=True)
class Listener:
    """What turns loads into sound, whatever the draw.

    Attributes
    ----------
    study : options, highest frequency and order
    rigid, modes : pressure per velocity of the rigid motions and of the shell's modes
    path : the elastic shell; none where no source drives it
    wrench_pressure : of the wrenches over crank angle, by case and source, (receiver, order)
    bands : third octaves
    """

    study: Study
    rigid: PressurePerVelocity
    modes: PressurePerVelocity
    path: ShellPath | None
    wrench_pressure: Mapping[At, Mapping[str, ComplexArray]]
    bands: tuple[levels.Band, ...]

    def hear(
        self, cases: Mapping[At, Case], loads: Mapping[At, Mapping[str, Loads]], draw: Draw
    ) -> dict[At, CaseSound]:
        """Sound of every case with one set of values."""
        way = SoundPath(self.rigid, self._shell(draw))
        return {at: self._case(at, case, loads[at], way) for at, case in cases.items()}

    def _shell(self, draw: Draw) -> BendingShell | None:
        if self.path is None:
            return None
        machine = with_draw(self.study.machine, self.study.machine, draw)
        loss = machine.table(ShellStructure).loss_factor_ratio
        return BendingShell(self.path, self.modes, loss, machine.table(ShellVariation))

    def _case(self, at: At, case: Case, loads: Mapping[str, Loads], way: SoundPath) -> CaseSound:
        given = self.wrench_pressure[at]
        receivers, most = next(iter(given.values())).shape
        orders = min(most, self.study.highest_order(case.speed_rpm) + 1)  # silent beyond
        highest = max(orders - 1, case.maximum_order) if self.study.drives_shell else orders - 1
        lines = lines_of(loads, case.shaft_frequency_hz, highest, len(JOINTS))
        further = way.pressure(on_mounts(case.machine), lines)
        pressure = np.zeros((len(loads), receivers, lines.frequency_hz.size), dtype=complex)
        for number, source in enumerate(loads):
            pressure[number] += further[source]
            if source in given:
                pressure[number, :, :orders] += given[source][:, :orders]
        noise = [
            NoisePower(number, part.frequency_hz, way.noise_power(part))
            for number, source in enumerate(loads)
            for part in loads[source].noise
        ]
        return self._quieted(at[1], lines, pressure, noise)

    def _quieted(
        self, option: str, lines: Lines, pressure: ComplexArray, noise: list[NoisePower]
    ) -> CaseSound:
        """With what the option takes off the airborne sound."""
        loss = self.study.options[option].insertion_loss()
        if loss is not None:
            pressure = pressure * 10.0 ** (-loss.at(lines.frequency_hz) / 20.0)
            noise = [
                NoisePower(
                    own.source,
                    own.frequency_hz,
                    own.power * 10.0 ** (-loss.at(own.frequency_hz) / 10.0),
                )
                for own in noise
            ]
        heard = source_sound(pressure, lines.frequency_hz, noise, self.bands, A_FIRST)
        return CaseSound(lines, pressure, heard)


def sound_of_draws(
    listener: Listener, cases: Mapping[At, Case], draws: list[Draw], progress: Progress
) -> list[dict[At, SourceSound]]:
    """Mean squares by source of every case, for every draw."""

    def heard(draw: Draw) -> dict[At, SourceSound]:
        drawn = with_values(cases, listener.study, draw)
        loads = {at: loads_of(listener.study, case) for at, case in drawn.items()}
        return {at: own.by_source for at, own in listener.hear(drawn, loads, draw).items()}

    found = []
    with ThreadPoolExecutor(processors()) as pool:  # the keys run without the interpreter's lock
        for sound in pool.map(heard, draws):
            found.append(sound)
            progress("sources", len(found), len(draws))
    return found


def levels_of(
    study: Study, motion: Motion, path: ShellPath | None, progress: Progress
) -> xr.Dataset:
    """Levels of all sources with the values as given and with every draw.

    Parameters
    ----------
    study : speeds, options, published level, uncertainty
    motion : its results hold the transfer vectors
    path : the elastic shell
    progress : told of the advance

    Raises
    ------
    ParameterError, SolverError
        The model is louder than the published level, as given or in nearly every draw.
    """
    catalogue = _at_catalogue_speed(study, motion)
    listener = _listener(study, motion, catalogue, path)
    cases, loads = {**catalogue.cases, **motion.cases}, {**catalogue.loads, **motion.loads}
    given = listener.hear(cases, loads, AS_GIVEN)
    draws = latin_hypercube(study.ranges, study.uncertainty)
    sounds = sound_of_draws(listener, cases, draws, progress)
    places = _places(study, motion.results, given, listener.bands)
    left = remaining_share(study.options)
    by_source = {at: own.by_source for at, own in given.items()}
    rest = _remainder(study, by_source, places, bool(draws))
    pressure = _line_pressure(study, places, given)
    orders = motion.results["order_frequency"]
    found = levels.level_variables(
        places,
        by_source,
        A_FIRST,
        pressure["pressure_line"].values[..., : orders.sizes["order"]].sum(axis=2),
        orders,
        rest * left,
    )
    found = found.merge(pressure)
    if not draws:
        return found
    rests = np.array([_remainder(study, sound, places, True) for sound in sounds])
    if np.count_nonzero(rests) < LEAST_DRAWS:
        raise SolverError(
            f"uncertainty.random_samples: only {np.count_nonzero(rests)} of {rests.size} draws are "
            f"below the published level, {LEAST_DRAWS} are needed; draw more, or look at the ranges"
        )
    values = _drawn_values(study, draws)
    return found.merge(levels.draw_variables(places, sounds, rests, left)).merge(values)


LEAST_DRAWS: Final = 3
"""Draws that must be left for a band."""


def _at_catalogue_speed(study: Study, motion: Motion) -> Motion:
    """The reference option at the speed of the published level, where that is no other's."""
    speed = study.machine.overall_noise.speed_rpm
    if speed in study.operation.speed_rpm:
        return replace(motion, cases={}, loads={})
    reference = {REFERENCE_OPTION: study.options[REFERENCE_OPTION]}
    return motion_of(at_speeds(study, (speed,), reference), lambda *_: None)


def _remainder(
    study: Study, sound: Mapping[At, SourceSound], places: levels.Places, may_be_none: bool
) -> float:
    """Mean square that the model leaves of the published level at its microphone and speed, Pa².

    With draws, none is left where the model alone is louder.
    """
    published = study.machine.overall_noise
    receiver = list(places.receivers).index(study.catalogue_receiver)
    alone = sound[published.speed_rpm, REFERENCE_OPTION].total[0, receiver]
    rest = REFERENCE_PRESSURE_PA**2 * 10.0 ** (published.level_dba / 10.0) - alone
    if rest <= 0.0 and not may_be_none:
        raise ParameterError(
            f"machine: overall_noise.level_dba = {published.level_dba:g} dB(A): the model alone "
            f"gives {levels.level(alone):.1f} dB(A) at {study.catalogue_receiver}"
        )
    return float(max(rest, 0.0))


def _places(
    study: Study,
    results: xr.Dataset,
    given: Mapping[At, CaseSound],
    bands: tuple[levels.Band, ...],
) -> levels.Places:
    sources = list(next(iter(given.values())).lines.rigid)
    receivers = [str(name) for name in results["receiver"].values]
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    return levels.Places(speeds, options, sources, receivers, bands)


def _line_pressure(
    study: Study, places: levels.Places, given: Mapping[At, CaseSound]
) -> xr.Dataset:
    """Pressure by source at all lines; tones of one name are one line, empty where it is none."""
    cases = {at: given[at] for at in product(places.speeds, places.options)}
    names = list(dict.fromkeys(name for own in cases.values() for name in own.lines.names))
    names.sort(key=lambda name: not name.startswith("order "))  # orders first, else as they come
    place = {name: number for number, name in enumerate(names)}
    shape = tuple(
        map(len, (places.speeds, places.options, places.sources, places.receivers, names))
    )
    pressure = np.zeros(shape, dtype=complex)
    frequency = np.full((shape[0], shape[-1]), np.nan)
    for s, speed in enumerate(places.speeds):
        for o, option in enumerate(places.options):
            own = cases[speed, option]
            at = [place[name] for name in own.lines.names]
            pressure[s, o][..., at] = own.pressure
            frequency[s, at] = own.lines.frequency_hz
    coords = {
        "speed": list(places.speeds),
        "option": list(places.options),
        "sound_source": list(places.sources),
        "receiver": list(places.receivers),
        "line": names,
    }
    orders = [float(name[6:]) if name.startswith("order ") else np.nan for name in names]
    return check(
        xr.Dataset(
            {"pressure_line": stamp("pressure_line", pressure, coords)},
            coords={
                "tone_frequency": (("speed", "line"), frequency),
                "line_order": ("line", orders),
            },
        )
    )


def _drawn_values(study: Study, draws: list[Draw]) -> xr.Dataset:
    names = [f"{own.table}.{own.field}" for own in study.ranges]
    values = [[draw[own.table, own.field] for own in study.ranges] for draw in draws]
    coords = {"draw": np.arange(1, len(draws) + 1), "drawn_parameter": names}
    return check(xr.Dataset({"drawn_value": stamp("drawn_value", values, coords)}))


def _listener(study: Study, motion: Motion, catalogue: Motion, path: ShellPath | None) -> Listener:
    results = motion.results
    at_catalogue = catalogue.results.assign(transfer_vector=results["transfer_vector"])
    return Listener(
        study,
        pressure_per_velocity(results["transfer_vector"]),
        pressure_per_shell_velocity(results) if path else _silent,
        path,
        {
            **_wrench_pressure(at_catalogue, catalogue.of_wrench),
            **_wrench_pressure(results, motion.of_wrench),
        },
        levels.filled_thirds(study.radiation.maximum_frequency_hz),
    )


def _silent(frequency_hz: Array) -> ComplexArray:
    raise SolverError("the shell has no modes")


def _wrench_pressure(
    results: xr.Dataset, of_wrench: Mapping[str, str]
) -> dict[At, dict[str, ComplexArray]]:
    """Pressure of the wrenches over crank angle, by case and source of sound."""
    dims = ("speed", "option", "source", "receiver", "order")
    pressure = wrench_pressure(results, "transfer_vector").transpose(*dims).values
    wrenches = [str(name) for name in results["source"].values]
    rows = {
        source: [number for number, name in enumerate(wrenches) if of_wrench[name] == source]
        for source in dict.fromkeys(of_wrench.values())
    }
    return {
        (float(speed), str(option)): {
            source: pressure[s, o, own].sum(axis=0) for source, own in rows.items()
        }
        for s, speed in enumerate(results["speed"].values)
        for o, option in enumerate(results["option"].values)
    }
