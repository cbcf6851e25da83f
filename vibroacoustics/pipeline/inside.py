"""Inner sources of a study: their sound at the receivers, with a band for what is not known."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr
from scipy.stats import qmc

from .. import levels
from ..constants import REFERENCE_PRESSURE_PA
from ..parameters.inside import Doubt, Inside, InsideSettings
from ..parameters.oldham_scroll import OldhamScroll
from ..parameters.options import Option, TwinOldham
from ..parameters.study import Study
from ..rotation import Array
from ..schema import REFERENCE_OPTION, RIGID_BODY_DOFS, check, stamp
from ..transfer import RigidBodyOnMounts
from .inner_sound import (
    ShellPath,
    SourceSound,
    mode_pressures,
    octave_thirds,
    pressure_per_load,
    rigid_pressures,
    source_sound,
)
from .inner_sources import KEY_COMPONENTS, Complex, InnerLoads, Operating, inner_loads, ring_force
from .progress import Progress

MOVING_PARTS: Final = "moving_parts"
QUANTILES: Final = (0.1, 0.5, 0.9)
WIDE_RATIO: Final = 3.0
"""A range wider than this is drawn evenly over its logarithm."""
ROLL: Final = RIGID_BODY_DOFS.index("rz")


@dataclass(frozen=True)
class _Case:
    """What a draw needs of one speed and option, whatever the draw.

    Attributes
    ----------
    operating : the speed
    option : parameters of the option
    ring_force_n : of what hangs on the ring, shape (samples,)
    moving_parts_pa : sound of the rigid machine's orders, shape (receiver, order)
    """

    operating: Operating
    option: Option
    ring_force_n: Array
    moving_parts_pa: Complex


def inside_sound(
    study: Study,
    settings: InsideSettings,
    machine: OldhamScroll,
    results: xr.Dataset,
    path: ShellPath,
    progress: Progress,
) -> xr.Dataset:
    """Sound of every source at every receiver, as assumed and as a band over the ranges.

    Parameters
    ----------
    study : speeds, options, overall level
    settings : of its inner sources
    machine : of the study
    results : of the stages before, with the transfer vectors of the shell's modes
    path : the elastic shell
    progress : told of the advance
    """
    cases = _cases(study, results, settings, machine)
    draws = [settings.inside, *latin_hypercube(settings)]
    listener = _Listener(results, path, _body(machine), octave_thirds(path.maximum_frequency_hz))
    heard: list[dict[tuple[float, str], tuple[SourceSound, dict[str, float]]]] = []
    for number, inside in enumerate(draws):
        heard.append(_heard(cases, inside, machine, listener))
        progress("inner sources", number + 1, len(draws))
    return _labelled(study, results, heard, listener)


def latin_hypercube(settings: InsideSettings) -> list[Inside]:
    """Insides whose uncertain values are drawn from their ranges (McKay, Beckman, Conover 1979)."""
    sampler = qmc.LatinHypercube(len(settings.doubts), rng=settings.seed)
    return [
        _drawn(settings.inside, settings.doubts, row)
        for row in sampler.random(settings.random_samples)
    ]


def _drawn(inside: Inside, doubts: Sequence[Doubt], shares: Array) -> Inside:
    tables: dict[str, dict[str, float]] = {}
    for doubt, share in zip(doubts, shares, strict=True):
        wide = doubt.lowest > 0.0 and doubt.highest / doubt.lowest > WIDE_RATIO
        value = (
            doubt.lowest * (doubt.highest / doubt.lowest) ** share
            if wide
            else doubt.lowest + share * (doubt.highest - doubt.lowest)
        )
        tables.setdefault(doubt.table, {})[doubt.field] = float(value)
    return inside.model_copy(
        update={
            table: getattr(inside, table).model_copy(update=values)
            for table, values in tables.items()
        }
    )


def _cases(
    study: Study, results: xr.Dataset, settings: InsideSettings, machine: OldhamScroll
) -> dict[tuple[float, str], _Case]:
    pressure = results["pressure_order"].sum("source")
    hanging = results["force"].sel(source="balancer", axis="x")
    cases = {}
    for speed, line in zip(study.operation.speed_rpm, settings.line_frequency_hz, strict=True):
        operating = Operating(
            speed, line, study.radiation.maximum_frequency_hz, settings.key_revolutions
        )
        for name, option in study.options.items():
            at = {"speed": speed, "option": name}
            on_ring = hanging.sel(at).values
            carried = option.kind in HANGS_ON_RING
            cases[speed, name] = _Case(
                operating,
                option,
                ring_force(option, on_ring if carried else np.zeros_like(on_ring), machine, speed),
                pressure.sel(at).transpose("receiver", "order").values,
            )
    return cases


HANGS_ON_RING: Final = ("pendulum", "spring-mass", "spring-mass-printed")
"""Options whose moving parts push the ring."""


def _body(machine: OldhamScroll) -> RigidBodyOnMounts:
    return RigidBodyOnMounts(
        machine.housing, machine.mounts, -machine.shell.centre_of_mass_height_m
    )


@dataclass(frozen=True)
class _Listener:
    """The way from loads to receivers, which no draw changes but by its own factors."""

    results: xr.Dataset
    path: ShellPath
    body: RigidBodyOnMounts
    bands: tuple[levels.Band, ...]

    def hears(self, case: _Case, loads: InnerLoads, inside: Inside) -> SourceSound:
        """Sound of all sources, the moving parts of the rigid machine among them."""
        per_load = self._per_load(loads.frequency_hz, inside)
        rigid = rigid_pressures(self.results, loads.frequency_hz)[:, ROLL]
        orders = case.moving_parts_pa.shape[-1]
        moving = np.zeros((rigid.shape[0], loads.frequency_hz.size), dtype=complex)
        moving[:, :orders] = case.moving_parts_pa
        pressure: dict[str, Complex] = {MOVING_PARTS: moving}
        for source, lines in loads.lines.items():
            rolling = np.zeros((lines.roll_moment_n_m.size, 6), dtype=complex)
            rolling[:, ROLL] = lines.roll_moment_n_m
            roll_velocity = self.body.velocity(rolling, loads.frequency_hz)[:, ROLL]
            elastic = np.einsum("rjcf,jcf->rf", per_load, lines.load, optimize=True)
            pressure[source] = elastic + rigid * roll_velocity
        noise = {
            source: [
                self._per_load(part.frequency_hz, inside)[:, part.joint][:, KEY_COMPONENTS]
                for part in parts
            ]
            for source, parts in loads.noise.items()
        }
        return source_sound(loads, pressure, noise, self.bands)

    def _per_load(self, frequency_hz: Array, inside: Inside) -> Complex:
        gain = 10.0 ** (inside.doubt.mobility_change_db / 20.0)
        pressure: Complex = gain * pressure_per_load(
            self.path,
            mode_pressures(self.results, frequency_hz),
            frequency_hz,
            inside.shell.loss_factor_ratio,
            inside.doubt.frequency_factor_ratio,
        )
        return pressure

    def feet(self, loads: InnerLoads) -> dict[str, float]:
        """Largest force into a foot by the motor's torque at twice the line frequency."""
        motor = loads.lines["motor"]
        line = loads.line_name.index("2 x line")
        load = np.zeros((1, 6), dtype=complex)
        load[0, ROLL] = motor.roll_moment_n_m[line]
        force = self.body.foot_force(load, loads.frequency_hz[[line]])
        return {"foot_force_2x_line_n": float(np.max(np.linalg.norm(np.abs(force), axis=-1)))}


def _heard(
    cases: Mapping[tuple[float, str], _Case],
    inside: Inside,
    machine: OldhamScroll,
    listener: _Listener,
) -> dict[tuple[float, str], tuple[SourceSound, dict[str, float]]]:
    """Sound and figures of every case with one set of values."""
    found = {}
    known: dict[tuple[float, bytes, str], InnerLoads] = {}
    for key, case in cases.items():
        twin = case.option.model_dump_json() if isinstance(case.option, TwinOldham) else ""
        same = (key[0], case.ring_force_n.tobytes(), twin)
        if same not in known:
            known[same] = inner_loads(
                inside, machine, case.option, case.ring_force_n, case.operating
            )
        loads = known[same]
        sound = listener.hears(case, loads, inside)
        found[key] = sound, {**loads.facts, **listener.feet(loads)}
    return found


def _labelled(
    study: Study,
    results: xr.Dataset,
    heard: list[dict[tuple[float, str], tuple[SourceSound, dict[str, float]]]],
    listener: _Listener,
) -> xr.Dataset:
    """Levels of the assumed values, and quantiles of the draws."""
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    sources = list(heard[0][speeds[0], options[0]][0].sources)

    def gathered(part: str) -> Array:
        """Shape (draw, speed, option, ...)."""
        return np.array(
            [[[getattr(draw[s, o][0], part) for o in options] for s in speeds] for draw in heard]
        )

    by_case = {"speed": speeds, "option": options}
    by_source = {**by_case, "sound_source": sources, "receiver": results["receiver"].values}
    by_receiver = {**by_case, "receiver": results["receiver"].values}
    of_draws = {"quantile": list(QUANTILES)}
    alone, total = _level(gathered("weighted")), gathered("total")
    whole, remainder = _whole(study, results, total)
    reference = options.index(REFERENCE_OPTION)
    levels_of = {"level_all_sources": _level(total), "level_whole": _level(whole)}
    arrays = {
        "source_level": stamp("source_level", alone[0], by_source),
        "source_level_quantile": stamp(
            "source_level_quantile", _quantiles(alone), {**of_draws, **by_source}
        ),
        "source_share": stamp(
            "source_share", gathered("part")[0] / total[0][:, :, None], by_source
        ),
        "source_band_level": stamp(
            "source_band_level",
            _level(gathered("band")[0]),
            {**by_source, "band": [band.nominal_hz for band in listener.bands]},
        ),
        "inner_remainder_level": stamp(
            "inner_remainder_level", _quantiles(_level(remainder)), of_draws
        ),
    }
    for name, level in levels_of.items():
        change = level - level[:, :, [reference]]
        for label, values in ((name, level), (name.replace("level", "change"), change)):
            arrays[label] = stamp(label, values[0], by_receiver)
            arrays[f"{label}_quantile"] = stamp(
                f"{label}_quantile", _quantiles(values), {**of_draws, **by_receiver}
            )
    arrays["inner_figure"] = _figures(heard[0], speeds, options)
    labelled = check(xr.Dataset(arrays))
    exceeding = float(np.mean(remainder[1:] <= 0.0))
    return labelled.assign_attrs(draws=len(heard) - 1, draws_above_overall_level=exceeding)


def _level(mean_square: Array) -> Array:
    return levels.mean_square_level(mean_square, REFERENCE_PRESSURE_PA)


def _quantiles(draws: Array) -> Array:
    """Over the random draws; the first one is what is assumed."""
    return np.asarray(np.quantile(draws[1:], QUANTILES, axis=0))


def _whole(study: Study, results: xr.Dataset, total: Array) -> tuple[Array, Array]:
    """Mean squares of modelled sources and remainder together, and of the remainder by draw, Pa².

    The remainder completes the overall level at its microphone, speed and without a balancer; a
    draw that is louder alone leaves none.
    """
    overall = study.machine.overall_noise
    receiver = list(results["receiver"].values).index(study.catalogue_receiver)
    speed = study.operation.speed_rpm.index(overall.speed_rpm)
    option = list(study.options).index(REFERENCE_OPTION)
    published = REFERENCE_PRESSURE_PA**2 * 10.0 ** (overall.level_dba / 10.0)
    remainder = np.maximum(published - total[:, speed, option, receiver], 0.0)
    return total + remainder[:, None, None, None], remainder


def _figures(
    heard: Mapping[tuple[float, str], tuple[SourceSound, dict[str, float]]],
    speeds: Sequence[float],
    options: Sequence[str],
) -> xr.DataArray:
    names = list(dict.fromkeys(name for _, facts in heard.values() for name in facts))
    values = [
        [[heard[s, o][1].get(name, np.nan) for name in names] for o in options] for s in speeds
    ]
    return stamp(
        "inner_figure",
        values,
        {"speed": list(speeds), "option": list(options), "inner_figure_name": names},
    )
