"""Samples of the shell held against hammer tests: those that agree go on."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.errors import ParameterError, SolverError
from ..base.progress import Progress
from ..base.vocabulary import stamped
from ..machine.machine import Machine
from ..study.measured_shell import MeasuredShell
from ..study.samples import with_sample
from ..study.sampling import Sample
from ..study.study import Study
from ..transfer.path import ShellPath
from ..transfer.wall_mobility import Reference, ShellMobilities, Wall, wall_mobility, wall_of
from .shell_features import Features, ShellAgreement, Tolerances, features, shell_agreement

MOST_TRIED: Final = 8192
"""Samples that are held against a test."""
CHANCE: Final = 0.3
"""A sample whose likelihood is less than this part of the best one goes on by chance only."""
LEAST_LIKELIHOOD: Final = float(np.exp(-0.5 * 3.0 * 3.0**2))
"""Likelihood of gain, frequencies and loss factors that are three tolerances off each."""
OF_THE_SHELL: Final = ("structure", "variation", "frame", "shaft")
"""Tables that mobilities depend on."""
NO_MACHINE: Final = ShellAgreement(0.0, np.nan, np.nan, np.nan)


@dataclass
class HammerTest:
    """A hammer test of the shell, and how samples agree with it.

    Attributes
    ----------
    study : with its machine
    path : modes and joints of the shell
    settings : points and tolerances
    mobilities : measured mobilities
    measured : their features
    wall : points of the wall
    tried : all samples that were held against it
    agreements : agreement of each of them
    weights : weights of those that went on
    reference : likelihood to which weights are related
    """

    study: Study
    path: ShellPath
    settings: MeasuredShell
    mobilities: ShellMobilities
    measured: Features
    wall: Wall
    tried: list[Sample] = field(default_factory=list)
    agreements: list[ShellAgreement] = field(default_factory=list)
    weights: list[float] = field(default_factory=list)
    reference: float = 0.0

    @classmethod
    def of(
        cls,
        study: Study,
        path: ShellPath | None,
        settings: MeasuredShell,
        mobilities: ShellMobilities,
    ) -> "HammerTest":
        """Prepare a hammer test to hold samples against.

        Raises
        ------
        ParameterError
            No source drives an elastic shell, nothing is sampled, or a point is not on the wall.
        """
        if path is None:
            raise ParameterError("measured.shell: no source drives an elastic shell")
        if not study.ranges:
            raise ParameterError("measured.shell: weighs samples, and no value has a range")
        points = [(point.angle_rad, point.height_m) for point in settings.wall.values()]
        try:
            wall = wall_of(path, *np.array(points).T)
        except ParameterError as error:
            raise ParameterError(f"measured.shell.wall: {error}") from None
        measured = features(mobilities.mobility, mobilities.frequency_hz)
        return cls(study, path, settings, mobilities, measured, wall)

    def agreeing(
        self, batches: Iterable[list[Sample]], wanted: int, progress: Progress
    ) -> Iterator[list[Sample]]:
        """Batches of samples that go on.

        A sample of likelihood L goes on with the probability min(1, L/c) and the weight max(L, c),
        so that none is computed whose weight would be next to nothing, and the sum of weights is
        right on average (Russian roulette: Kahn 1956, Use of different Monte Carlo sampling
        techniques, RAND P-766).

        Parameters
        ----------
        batches : batches of samples from the ranges alone
        wanted : how many a batch shall have
        progress : called with the number of samples that were held against the test

        Raises
        ------
        ParameterError
            No sample agrees.
        """
        random = np.random.default_rng(self.study.uncertainty.seed)
        done = 0
        for batch in batches:
            self.agreements += [self._agreement(sample) for sample in batch]
            self.tried += batch
            progress("samples at the hammer test", len(self.tried), MOST_TRIED)
            likelihood = np.array([agreement.likelihood for agreement in self.agreements])
            least, fresh = CHANCE * likelihood.max(), likelihood[done:]
            is_last = len(self.tried) >= MOST_TRIED
            suffices = np.minimum(fresh, least).sum() >= wanted * least or is_last
            if likelihood.max() >= LEAST_LIKELIHOOD and suffices:
                self.reference = self.reference or float(likelihood.max())
                goes = fresh > least * random.uniform(size=fresh.size)
                self.weights += np.maximum(fresh, least)[goes].tolist()
                yield [sample for sample, go in zip(self.tried[done:], goes, strict=True) if go]
                done = len(self.tried)
            if is_last:
                break
        if self.reference == 0.0:
            raise ParameterError(self._why_none())

    def likelihood(self, before: int, count: int) -> Array:
        """Weights of samples that went on over that of the best, shape (count,)."""
        return np.array(self.weights[before : before + count]) / self.reference

    def _why_none(self) -> str:
        best = max(self.agreements, key=lambda agreement: agreement.likelihood, default=NO_MACHINE)
        return (
            f"measured.shell: none of {len(self.tried)} samples agrees with the hammer test within "
            f"three tolerances; the best one has {best.gain_db:+.1f} dB, "
            f"{best.frequency_ratio:.3f} of the natural frequencies and {best.loss_ratio:.2f} of "
            "the loss factors; check points and units, or give wider ranges or tolerances"
        )

    def _agreement(self, sample: Sample) -> ShellAgreement:
        try:
            return self.of_machine(with_sample(self.study.machine, self.study.machine, sample))
        except (ParameterError, SolverError):
            return NO_MACHINE

    def of_machine(self, machine: Machine) -> ShellAgreement:
        """Agreement of a machine's shell."""
        settings = self.settings
        tolerances = Tolerances(
            settings.gain_tolerance_db,
            settings.frequency_tolerance_ratio,
            settings.loss_tolerance_ratio,
        )
        sampled = features(self.mobility(machine), self.mobilities.frequency_hz)
        return shell_agreement(self.measured, sampled, tolerances)

    def mobility(self, machine: Machine) -> ComplexArray:
        """Compute the mobility of the measured pairs, m/(N s), shape (mobility, frequency)."""
        parts, names = self.settings.parts, list(self.settings.wall)
        used = list(dict.fromkeys(self.mobilities.reference))
        references: list[Reference] = [
            names.index(name) if name in names else (parts[name].part, parts[name].component)
            for name in used
        ]
        every = wall_mobility(
            machine, self.path, self.wall, references, self.mobilities.frequency_hz
        )
        rows = [names.index(name) for name in self.mobilities.response]
        return np.asarray(every[rows, [used.index(name) for name in self.mobilities.reference]])

    def labelled(self, before_dba: Array, gone: int) -> xr.Dataset:
        """Label the agreement of all samples, their values, and the measured peaks.

        Parameters
        ----------
        before_dba : modelled level of samples from the ranges alone, shape (sample,)
        gone : number of samples whose sound was computed
        """
        ranges = [
            limits for limits in self.study.ranges if limits.table.split(".")[0] in OF_THE_SHELL
        ]
        values = {
            "shell_likelihood": [agreement.likelihood for agreement in self.agreements],
            "shell_gain": [agreement.gain_db for agreement in self.agreements],
            "shell_frequency_ratio": [agreement.frequency_ratio for agreement in self.agreements],
            "shell_loss_ratio": [agreement.loss_ratio for agreement in self.agreements],
            "shell_value": [
                [sample[limits.table, limits.field] for limits in ranges] for sample in self.tried
            ],
            "shell_level_before": before_dba,
            "shell_weight": self.likelihood(0, gone),
        }
        if self.measured.peak_hz.size:
            values["shell_peak_loss"] = self.measured.loss_ratio
        coords = {
            "shell_sample": np.arange(1, len(self.tried) + 1),
            "shell_parameter": [limits.name for limits in ranges],
            "shell_level_sample": np.arange(1, len(before_dba) + 1),
            "prior_sample": np.arange(1, gone + 1),
            "shell_peak": self.measured.peak_hz,
        }
        labelled = stamped(values, coords)
        settings, frequency = self.settings, self.mobilities.frequency_hz
        labelled["shell_likelihood"].attrs |= {
            "mobilities": len(self.mobilities.mobility),
            "unused": self.mobilities.unused,
            "lowest_frequency_hz": float(frequency[0]),
            "highest_frequency_hz": float(frequency[-1]),
            "gain_tolerance_db": settings.gain_tolerance_db,
            "frequency_tolerance_ratio": settings.frequency_tolerance_ratio,
            "loss_tolerance_ratio": settings.loss_tolerance_ratio,
        }
        return labelled
