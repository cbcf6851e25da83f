"""Machines for which designs are computed: the nominal one, or the weighted samples of a study."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import power_of_level
from ..base.errors import ParameterError, SolverError
from ..base.progress import no_progress
from ..base.vocabulary import REFERENCE_OPTION
from ..levels.baseline import with_baseline
from ..levels.by_source import SourceSound, gain_band_number
from ..levels.lines import unmodelled_in_bands
from ..levels.nominal import NominalSound, by_source
from ..levels.remainder import remaining
from ..machine.cases import Cases
from ..machine.source import CaseKey
from ..pipeline.study import chain_with, run
from ..radiation.given import Radiation
from ..sound.tone_spectra import band_square
from ..stages.chain import Chain
from ..study.study import Study
from ..transfer.contributions import Transmission
from ..uncertainty.discrepancy import Discrepancy
from ..uncertainty.evidence import Evidence
from ..uncertainty.prior_ensemble import PriorEnsemble
from .engine.contraction import Contraction
from .engine.deviating import Gains, energy
from .engine.engine import Engine
from .engine.machine_sample import Deviation, MachineSample, Unmodelled
from .engine.needs import Need
from .engine.on_mounts import lines_of, noise_of, pressure_by_source
from .engine.response import a_weight
from .engine.sound_path import SoundPaths
from .keys import present_value
from .space import Space
from .tolerances import Pieces


@dataclass(frozen=True)
class ComparedMachine:
    """A machine with its designs and itself without an option.

    Attributes
    ----------
    machine : nominal, or a sample
    engine : engine of its designs
    reference : engine without an option, with tolerances of the values that no design chooses
    """

    machine: MachineSample
    engine: Engine
    reference: Engine


def compared_machines(
    study: Study, pieces: Pieces, needs: Sequence[Need], radiation: Radiation
) -> list[ComparedMachine]:
    """Samples of a study that have a solution; without uncertainty the nominal machine."""
    paths, machines = SoundPaths(radiation), _machines(study, pieces.wide.study, radiation)
    compared: list[ComparedMachine] = []
    for machine in machines:
        first = compared[0] if compared else None
        with suppress(*([ParameterError, SolverError] if len(machines) > 1 else [])):
            compared.append(_compared(pieces, needs, paths, machine, first))
    return compared


def _compared(
    pieces: Pieces,
    needs: Sequence[Need],
    paths: SoundPaths,
    machine: MachineSample,
    first: ComparedMachine | None,
) -> ComparedMachine:
    """Prepare a machine; variables act as they do in the first one."""
    space, bare = pieces.wide, pieces.without_designs
    gains = _gains(bare, paths, machine)
    of_designs, of_reference = (None, None) if first is None else (first.engine, first.reference)
    return ComparedMachine(
        machine,
        Engine(space, pieces.limits, needs, paths, machine, gains, of_designs),
        Engine(bare, pieces.limits_without_designs, needs, paths, machine, gains, of_reference),
    )


def _gains(space: Space, paths: SoundPaths, machine: MachineSample) -> tuple[Gains | None, ...]:
    """Discrepancies by speed, with the energy of the machine without an option."""
    study = space.study
    if machine.deviation is None:
        return (None,) * len(study.operation.speed_rpm)
    of_reference = Contraction(space, REFERENCE_OPTION, paths, machine)
    present = np.array([present_value(study, key) for key in space.names])
    probe = of_reference.probe(present)
    responses = of_reference.paths(probe.layout)(present).responses(probe.layout)
    body = {name: array[None] for name, array in probe.body.items()}
    gains = []
    for lines, part in zip(
        lines_of(study.operation.speed_rpm, probe.layout, responses), probe.by_speed, strict=True
    ):
        arrays = {name: np.asarray(array)[None] for name, array in part.items()}
        pressure = pressure_by_source(lines, arrays, body)
        band, weight = gain_band_number(lines.frequency_hz), a_weight(lines.frequency_hz)
        before = energy(pressure, weight, band, noise_of(lines, arrays)[0])[0]
        gains.append(Gains(machine.deviation.gain, machine.deviation.added, before))
    return tuple(gains)


def _machines(study: Study, cut: Study, radiation: Radiation) -> list[MachineSample]:
    """Samples of a study with uncertainty; the nominal machine where it has too few."""
    samples = list(_samples(cut, radiation)) if study.ranges else []
    return samples or [MachineSample(np.ones(1), unmodelled_of(study, radiation))]


def _samples(study: Study, radiation: Radiation) -> Iterator[MachineSample]:
    chain = chain_with(study, PriorEnsemble, radiation=radiation)
    ensemble, evidence = chain[PriorEnsemble], chain[Evidence]
    if not ensemble.suffices:
        return
    index, count = ensemble.chosen(study.uncertainty.seed)
    for number, times in zip(index.tolist(), count.tolist(), strict=True):
        sound, machine = ensemble.batch.sounds[number], ensemble.batch.machines[number]
        pairs = evidence.pairs_of(sound, machine, number)
        discrepancy, noise = pairs.discrepancy, evidence.unmodelled_pa2(pairs, machine)
        unmodelled = dict(
            zip(study.options, _unmodelled(chain, number, discrepancy, noise), strict=True)
        )
        yield MachineSample(
            times * pairs.weight[0],
            unmodelled.__getitem__,
            ensemble.samples[number],
            Deviation(discrepancy.gain, discrepancy.added),
        )


def _unmodelled(
    chain: Chain, number: int, discrepancy: Discrepancy, noise: Array
) -> list[Unmodelled]:
    """Noise beside the modelled sound of each option."""
    study, nominal, ensemble = chain.study, chain[NominalSound], chain[PriorEnsemble]
    machine, axes = ensemble.batch.machines[number], nominal.axes
    unmodelled = [remaining(study, axes, machine, of_pair) for of_pair in noise]
    sounds: list[dict[CaseKey, SourceSound]] = [{}] * len(unmodelled)
    if nominal.points:
        cases = chain.at(ensemble.samples[number])[Cases]
        sounds = discrepancy.sounds(by_source(study, axes, chain[Transmission].received(cases)))
    each = [
        with_baseline(study, axes, nominal.points, sound, of_pair)
        for sound, of_pair in zip(sounds, unmodelled, strict=True)
    ]
    thirds = unmodelled_in_bands(np.array(unmodelled))
    by_option = (np.moveaxis(part, 2, 0) for part in (np.array(each), thirds))
    return [Unmodelled(*part) for part in zip(*by_option, strict=True)]


def unmodelled_of(study: Study, radiation: Radiation) -> Callable[[str], Unmodelled]:
    """Return what gives the noise beside the modelled sound of an option of the nominal machine.

    It has one pair. The study is run at the first call.
    """

    @cache
    def of_options() -> dict[str, Unmodelled]:
        operation = study.operation.model_copy(update={"stopping": False, "turning_back": False})
        nominal = study.model_copy(update={"ranges": (), "operation": operation})
        results = run(nominal, no_progress, radiation)
        modelled = results["level_modelled"].sel(weighting="A")
        residual = power_of_level(results["level_total"]) - power_of_level(modelled)
        dims = ("option", "speed", "receiver")
        squares = REFERENCE_PRESSURE_PA**2 * residual.transpose(*dims).values
        level_db = results["unmodelled_band_level"].transpose(*dims, "noise_band").values
        parts = zip(np.maximum(squares, 0.0)[:, None], band_square(level_db)[:, None], strict=True)
        options = results["option"].values.tolist()
        return {name: Unmodelled(*part) for name, part in zip(options, parts, strict=True)}

    return lambda option: of_options()[option]
