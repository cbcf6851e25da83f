"""Designs on the same mounts: sound is a sum of squares of a few sums."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from .deviating import WeightedLines, varied_bands
from .expansion import Expansion, summed
from .hearing import HEARING, Spectrum
from .needs import PAIRED, Need
from .on_mounts import Arrays, Lines, heard_spectrum, noise_of, pressure_by_source, seen_of

RANK: Final = 1e-13
"""Part of the largest singular value below which others are rounding."""
SOLVED: Final = ("mass", "stiffness", "foot", "added", "foot_added", "factor")
"""Arrays that must be the same for all designs."""
UNHEARD: Final = 1e-10
"""Share of the energy of a receiver that designs change in bands that count as constant."""
BY_LINE: Final = ("wrench", "added", "foot_added")


def is_fixed(by_speed: Sequence[Expansion], body: Expansion) -> bool:
    """Return whether all designs are on the same mounts, behind the same hood."""
    return all(
        name not in part.factors or part.is_constant(name)
        for part in (*by_speed, body)
        for name in SOLVED
    )


@dataclass(frozen=True)
class FixedSpeed:
    """One speed of designs on the same mounts, prepared for the requested responses.

    Attributes
    ----------
    lines : lines of the orders that are requested other than as sound
    arrays : expansion of all arrays but those of the sound, at these lines
    noise : factors of all random loads, shape (product, receiver)
    """

    lines: Lines
    arrays: Expansion
    noise: Array

    @classmethod
    def of(cls, needs: Sequence[Need], lines: Lines, arrays: Expansion) -> "FixedSpeed":
        """Prepare a speed for the requested responses."""
        orders = {need.order for need in needs if need.what in ("force", "moment", "foot")}
        rows = np.array([row for order in orders for row in lines.row(order)], dtype=np.intp)
        figures = {need.name for need in needs if need.what == "figure"}
        factors = arrays.factors
        few = {name: factors[name][:, rows] for name in BY_LINE if name in factors}
        few |= {name: factors[name] for name in figures if name in factors}
        few = {name: part for name, part in few.items() if name in figures or rows.size}
        expansion = Expansion(arrays.terms, arrays.speed_rpm, few)
        noise = noise_of(lines, factors)[0]
        return cls(lines.select(rows), expansion, noise.sum(axis=(1, 3)))


def compressed(order: int | None, lines: Lines, arrays: Expansion, body: Arrays) -> Array:
    """Compute rows whose squared sums make the mean square, shape (receiver, row, product).

    All lines of a receiver are linear in the products of the variables: real and imaginary parts
    of every line, weighted, are a matrix A, and |A g|² = |S Vᵀ g|² by its singular values, as few
    as there are independent products.

    Parameters
    ----------
    order : order of the sound; none for all of it, A-weighted
    lines : lines of the speed
    arrays : expansion of their arrays
    body : mass and stiffness of all designs, shape (1, ...)
    """
    rows, weighted = lines.weighted(order)
    total = _factors(lines, rows, arrays, body).sum(axis=1) * np.sqrt(weighted.level_weight)
    parts = np.concatenate([total.real, total.imag], axis=2)  # (product, receiver, 2 lines)
    return _squeezed(np.moveaxis(parts, (1, 2, 0), (0, 1, 2)))


def _factors(lines: Lines, rows: IndexArray, arrays: Expansion, body: Arrays) -> ComplexArray:
    """Pressure per product of the variables, shape (product, source, receiver, line), Pa."""
    factors = arrays.factors
    few = {name: factors[name][:, rows] for name in ("load", "shell")}
    few |= {name: factors[name][:1, rows] for name in ("factor", "added") if name in factors}
    return pressure_by_source(lines.select(rows), few, body)


@dataclass(frozen=True)
class PairedSound:
    """Sound of one need at one speed with the discrepancies of a sample.

    Attributes
    ----------
    lines : lines in the bands that designs change
    pressure : pressure per product of the variables, shape (product, source, receiver, line), Pa
    noise : mean squares in these bands, shape (product, source, receiver, band), Pa²
    constant : mean square in the other bands, shape (pair, receiver), Pa²
    """

    lines: WeightedLines
    pressure: ComplexArray
    noise: Array
    constant: Array

    @classmethod
    def of(
        cls, order: int | None, lines: Lines, arrays: Expansion, body: Arrays, columns: Array
    ) -> "PairedSound":
        """Prepare the sound of an order, or of all lines.

        Parameters
        ----------
        order, lines, arrays, body : see `compressed`
        columns : products of designs that fill the space, shape (design, product)
        """
        rows, weighted = lines.weighted(order)
        pressure = _factors(lines, rows, arrays, body)
        noise, _ = noise_of(lines, arrays.factors)
        change = summed(columns, pressure) - pressure[:1]
        of_designs = np.asarray(np.tensordot(columns, noise, axes=1))
        bands = varied_bands(change, pressure[:1], weighted, of_designs, UNHEARD)
        varied = bands[weighted.band]
        others = weighted.some(~varied, ~bands)
        constant = others.mean_square(pressure[:1, ..., ~varied], noise[:1, ..., ~bands])[0]
        some = weighted.some(varied, bands)
        return cls(some, pressure[..., varied], noise[..., bands], constant)

    def mean_square(self, columns: Array) -> Array:
        """Compute the mean square of designs, shape (design, pair, receiver), Pa².

        Parameters
        ----------
        columns : products of the variables, shape (design, product)
        """
        noise: Array = np.asarray(np.tensordot(columns, self.noise, axes=1), dtype=float)
        square: Array = self.lines.mean_square(summed(columns, self.pressure), noise)
        return square + self.constant


@dataclass(frozen=True)
class FixedSpectrum:
    """Lines and noise of designs at one speed, from which loudness and audibility are computed.

    Attributes
    ----------
    lines : lines of the speed
    pressure : pressure per product of the variables, shape (product, source, receiver, line), Pa
    noise, thirds : mean squares of random loads, A-weighted and unweighted, shape
        (product or 1, source, receiver, band), Pa²; a single product where designs do
        not change them
    """

    lines: Lines
    pressure: ComplexArray
    noise: Array
    thirds: Array

    @classmethod
    def of(cls, lines: Lines, arrays: Expansion, body: Arrays) -> "FixedSpectrum":
        """Prepare a speed; see `compressed`."""
        pressure = _factors(lines, lines.row(None), arrays, body)
        noise, thirds = map(_constant, noise_of(lines, arrays.factors))
        return cls(lines, pressure, noise, thirds)

    def of_designs(self, columns: Array) -> Spectrum:
        """Compute the spectra of designs.

        Parameters
        ----------
        columns : products of the variables, shape (design, product)
        """
        noise, thirds = (_of_designs(columns, part) for part in (self.noise, self.thirds))
        pressure = summed(columns, self.pressure)
        return heard_spectrum(self.lines, pressure, noise, thirds, len(columns))


def _of_designs(columns: Array, factors: Array) -> Array:
    """Return the sums of products of each design; of one where `factors` has the constant alone."""
    count = len(columns) if len(factors) > 1 else 1
    return np.asarray(np.tensordot(columns[:count, : len(factors)], factors, axes=1))


def _constant(factors: Array) -> Array:
    """Return the factors, or that of the constant alone where the others are zero."""
    return factors if factors[1:].any() else factors[:1]


def _squeezed(matrices: Array) -> Array:
    """Compute S Vᵀ of each matrix, shape (receiver, rank, product)."""
    _, sizes, directions = np.linalg.svd(matrices, full_matrices=False)
    largest = max(float(sizes.max(initial=0.0)), 1e-300)
    rank = max(int((sizes > RANK * largest).any(axis=0).sum()), 1)
    return np.asarray((sizes[..., None] * directions)[:, :rank])


@dataclass(frozen=True)
class FixedMounts:
    """Designs on the same mounts, computed by a few sums each.

    Attributes
    ----------
    speeds : prepared speeds
    body : mass, stiffness and foot, shape (1, ...)
    sums : sums of products that make all sound, shape (sum, product)
    sound : rows of these sums by need, whose squared sums make the mean square, shape
        (speed, receiver, row, sum)
    paired : sound by need and speed, in place of these rows where the machine is a sample
    spectra : spectra by speed, where loudness or audibility is requested
    """

    speeds: tuple[FixedSpeed, ...]
    body: Arrays
    sums: Array
    sound: dict[Need, Array]
    paired: dict[Need, list[PairedSound]]
    spectra: tuple[FixedSpectrum, ...] = ()

    @classmethod
    def of(
        cls,
        needs: Sequence[Need],
        lines: Sequence[Lines],
        by_speed: Sequence[Expansion],
        body: Expansion,
        designs: Array,
    ) -> "FixedMounts":
        """Prepare designs for the requested responses.

        Parameters
        ----------
        needs : requested responses
        lines, by_speed : lines of each speed and the expansion of their arrays
        body : expansion of the arrays of the body
        designs : designs that fill the space, shape (design, variable)
        """
        bare = {name: factors[:1] for name, factors in body.factors.items()}
        pairs = list(zip(lines, by_speed, strict=True))
        speeds = tuple(FixedSpeed.of(needs, *pair) for pair in pairs)
        sounds = [need for need in needs if need.what == "sound"]
        spectra: tuple[FixedSpectrum, ...] = ()
        if any(need in HEARING for need in needs):
            spectra = tuple(FixedSpectrum.of(*pair, bare) for pair in pairs)
        if lines[0].gains is not None:
            columns = [part.terms.evaluate(designs, part.speed_rpm) for part in by_speed]
            paired = {
                need: [
                    PairedSound.of(need.order, *pair, bare, products)
                    for pair, products in zip(pairs, columns, strict=True)
                ]
                for need in sounds
            }
            return cls(speeds, bare, np.zeros((1, 1)), {}, paired, spectra)
        rows = {
            need: _stacked([compressed(need.order, *pair, bare) for pair in pairs])
            for need in sounds
        }
        nothing = np.zeros((1, len(by_speed[0].terms.products)))
        sums = _directions(np.concatenate([nothing, *map(_scaled, rows.values())]))
        sound = {need: part @ sums.T for need, part in rows.items()}
        return cls(speeds, bare, sums, sound, {}, spectra)

    def results(self, needs: Sequence[Need], values: Array) -> dict[Need, Array]:
        """Compute the responses of designs.

        Parameters
        ----------
        needs : requested responses, among the prepared ones
        values : values of the designs, shape (design, variable), SI
        """
        by_speed = self._columns(values)
        others = [need for need in needs if need.what not in PAIRED]
        arrays = [
            {name: summed(columns, factors) for name, factors in speed.arrays.factors.items()}
            for speed, columns in zip(self.speeds, by_speed, strict=True)
        ]
        lines = [speed.lines for speed in self.speeds]
        figures = seen_of(others, lines, arrays, self.body, len(values))
        sounds = [need for need in needs if need.what == "sound"]
        figures |= {need: self._sound(need, by_speed) for need in sounds}
        return figures

    def spectra_of(self, values: Array) -> list[Spectrum]:
        """Compute the spectra of designs by speed; see `results`."""
        each = zip(self.spectra, self._columns(values), strict=True)
        return [spectrum.of_designs(columns) for spectrum, columns in each]

    def _columns(self, values: Array) -> list[Array]:
        """Compute products of the variables by speed, once where all speeds share them."""
        first, *others = self.speeds
        columns = first.arrays.terms.evaluate(values, first.lines.speed_rpm)
        if not first.arrays.terms.by_speed:
            return [columns] * len(self.speeds)
        of_others = (speed.arrays.terms.evaluate(values, speed.lines.speed_rpm) for speed in others)
        return [columns, *of_others]

    def _sound(self, need: Need, by_speed: Sequence[Array]) -> Array:
        """Compute the mean square, shape (design, pair, speed, receiver), Pa²."""
        if self.paired:
            each = zip(self.paired[need], by_speed, strict=True)
            return np.stack([sound.mean_square(columns) for sound, columns in each], axis=2)
        rows, shared = self.sound[need], not self.speeds[0].arrays.terms.by_speed
        count = len(by_speed[0])
        square = np.empty((count, *rows.shape[:2]))
        sums = by_speed[0] @ self.sums.T
        for speed, of_speed in enumerate(rows):
            if not shared:
                sums = by_speed[speed] @ self.sums.T
            each = sums @ of_speed.reshape(-1, len(self.sums)).T
            each = np.square(each, out=each).reshape(count, *of_speed.shape[:2])
            np.einsum("nrk->nr", each, out=square[:, speed])
            if need.order is None and self.speeds[speed].noise.any():
                square[:, speed] += by_speed[speed] @ self.speeds[speed].noise
        return square[:, None]


def _stacked(parts: Sequence[Array]) -> Array:
    """Stack rows of all speeds, filled with zeros, shape (speed, receiver, row, product)."""
    most = max(part.shape[1] for part in parts)
    return np.stack([np.pad(part, ((0, 0), (0, most - part.shape[1]), (0, 0))) for part in parts])


def _directions(rows: Array) -> Array:
    """Return the fewest independent sums that make all rows, shape (sum, product)."""
    _, sizes, directions = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(directions[: max(int((sizes > RANK * sizes[0]).sum()), 1)])


def _scaled(rows: Array) -> Array:
    """Divide rows of each speed and receiver by their largest: quiet ones count as loud ones."""
    size = np.abs(rows).max(axis=(2, 3), keepdims=True)
    scaled = rows / np.where(size > 0.0, size, 1.0)
    return np.asarray(scaled.reshape(-1, rows.shape[-1]))
