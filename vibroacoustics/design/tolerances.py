"""Scatter from piece to piece: samples of values about those of a design."""

from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.stats import qmc

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..base.units import split_key
from ..base.vocabulary import REFERENCE_OPTION
from ..study.study import Study
from .keys import check_key, present_value
from .space import Space, without_others
from .variable import Variable

_RANDOM: Final = 4


@dataclass(frozen=True)
class Scatter:
    """Uniform scatter of one value: x (1 + r u) + d u, or in a range of its values.

    Attributes
    ----------
    column : column of the value among those of the wide space
    ratio : r
    distance : d, SI
    limits : ends of the range, SI; none where the value scatters about what is meant
    integer : whether the value is rounded to an integer
    """

    column: int
    ratio: float = 0.0
    distance: float = 0.0
    limits: tuple[float, float] | None = None
    integer: bool = False

    def pieces_of(self, meant: Array, share: Array) -> Array:
        """Values of pieces; shares from 0 to 1 of the way from the lowest to the highest."""
        if self.limits is not None:
            low, high = self.limits
            value = low + share * (high - low) + 0.0 * meant
            return np.asarray(np.rint(value) if self.integer else value)
        unit = 2.0 * share - 1.0
        return np.asarray(meant * (1.0 + self.ratio * unit) + self.distance * unit)

    def meant_share(self, present: Array, first: int) -> float:
        """Return the share that gives the value as meant; it may be outside of 0 to 1.

        Parameters
        ----------
        present : values that scatter alone as meant, shape (further variable,), SI
        first : column of the first of them
        """
        if self.limits is None or self.column < first:
            return 0.5
        low, high = self.limits
        return float((present[self.column - first] - low) / (high - low))


@dataclass(frozen=True)
class Pieces:
    """Designs as they are made.

    Attributes
    ----------
    wide : the space with the values that scatter alone as further variables
    scatters : scatters of the values
    present : values of the further variables as meant, shape (further variable,), SI
    """

    wide: Space
    scatters: tuple[Scatter, ...]
    present: Array

    @classmethod
    def of(cls, study: Study, space: Space) -> "Pieces":
        """Pieces of the designs of a study.

        Raises
        ------
        ParameterError
            A tolerance names no number of the study.
        """
        design = study.design
        names, further, scatters, present = list(space.names), [], [], []
        for key, entry in (design.tolerances if design else {}).items():
            where = f"{study.source_file}: design.tolerances.{key}"
            check_key(key, space.options, where)
            unit = split_key(key.rpartition(".")[2])[1]
            symbol, factor = (unit.symbol, unit.factor) if unit else ("", 1.0)
            integer = False
            if key not in names:
                try:
                    value = present_value(space.study, key)
                except ParameterError as error:
                    raise ParameterError(f"{where}: {error}") from None
                integer = isinstance(value, int)
                names.append(key)
                present.append(value)
                further.append(Variable(key, symbol, factor, (value, value), integer=integer))
            limits = (
                None if entry.range is None else (factor * entry.range[0], factor * entry.range[1])
            )
            ratio, distance = entry.ratio or 0.0, factor * (entry.plus_minus or 0.0)
            scatters.append(Scatter(names.index(key), ratio, distance, limits, integer))
        wide = Space(space.study, space.options, (*space.variables, *further))
        pieces = cls(wide, tuple(scatters), np.array(present))
        wide.check_ends(pieces.limits, "tolerances")
        return pieces

    @property
    def limits(self) -> Array:
        """Lowest and highest values of pieces, shape (variable, 2), SI."""
        limits = self.wide.limits.copy()
        for scatter in self.scatters:
            ends = limits[scatter.column]
            made = [scatter.pieces_of(ends, np.full(2, share)) for share in (0.0, 1.0)]
            limits[scatter.column] = np.min(made), np.max(made)
        return limits

    @property
    def without_designs(self) -> Space:
        """The machine without an option, with the values that scatter but no design chooses."""
        further = self.wide.variables[-self.present.size :] if self.present.size else ()
        alone = without_others(self.wide.study, (REFERENCE_OPTION,))
        return Space(alone, (REFERENCE_OPTION,), further)

    @property
    def limits_without_designs(self) -> Array:
        """Lowest and highest values of these, shape (variable, 2), SI."""
        return self.limits[len(self.limits) - self.present.size :]

    @property
    def as_meant(self) -> Array:
        """Shares of the ranges that give the piece as meant, shape (1, scatter).

        A value that scatters in a range of its own, such as a start, is that of the file.
        """
        first = len(self.wide.variables) - self.present.size
        shares = [scatter.meant_share(self.present, first) for scatter in self.scatters]
        return np.array(shares).reshape(1, -1)

    def samples(self, count: int, number: int = 0) -> Array:
        """Shares of the ranges, shape (sample, scatter), the same at every call.

        Parameters
        ----------
        count : number of samples
        number : number of the set; sets of other numbers are independent
        """
        if not self.scatters:
            return np.zeros((1, 0))
        sampler = qmc.LatinHypercube(len(self.scatters), rng=_RANDOM + number)
        return np.asarray(sampler.random(count))

    def of_run(self, seed: int, run: int, count: int) -> Array:
        """Random shares of the ranges for a run of an active search, shape (sample, scatter).

        Parameters
        ----------
        seed : seed of the search
        run : number of the run; other runs have independent shares
        count : number of samples
        """
        rng = np.random.default_rng((_RANDOM, seed, run))
        return rng.random((count, len(self.scatters)))

    def made(self, designs: Array, samples: Array) -> Array:
        """Values of pieces, shape (design, sample, variable).

        Parameters
        ----------
        designs : shape (design, variable of the space)
        samples : shape (sample, scatter)
        """
        meant = np.concatenate([designs, np.tile(self.present, (len(designs), 1))], axis=1)
        pieces = np.repeat(meant[:, None], len(samples), axis=1)
        for scatter, share in zip(self.scatters, samples.T, strict=True):
            column = scatter.column
            pieces[:, :, column] = scatter.pieces_of(meant[:, None, column], share)
        return pieces
