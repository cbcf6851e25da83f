"""Responses of designs whose arrays are known: each moves on its mounts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.errors import ParameterError
from ...levels.by_source import GAIN_BANDS, gain_band_number
from .deviating import Gains, WeightedLines
from .hearing import HEARING, Spectrum
from .layout import Layout
from .needs import Need
from .response import a_weight, displacement, foot_forces, natural_modes, pressure, size_of_vector
from .sound_path import RandomResponse, Responses

Arrays = Mapping[str, ComplexArray]
ADDED = ("added", "foot_added")
SOUND = ("load", "shell", "factor", "added")
"""Arrays by line on which the pressure depends."""


@dataclass(frozen=True)
class Lines:
    """Lines of one speed.

    Attributes
    ----------
    speed_rpm : speed of the shaft, rpm
    frequency_hz, order : frequencies, Hz, and orders, shape (line,); order 0 for tones that are
        none
    responses : pressure per motion and load
    gains : gains of a sample; none for the nominal machine
    unmodelled : mean squares of unmodelled noise, shape (pair, receiver, band), Pa²; none where
        nothing depends on it
    """

    speed_rpm: float
    frequency_hz: Array
    order: IndexArray
    responses: Responses
    gains: Gains | None = None
    unmodelled: Array | None = None

    @property
    def receivers(self) -> int:
        """Number of microphones."""
        return len(self.responses.per_velocity)

    def select(self, rows: IndexArray) -> "Lines":
        """Return some of the lines."""
        per_velocity, per_load, random = vars(self.responses).values()
        return replace(
            self,
            frequency_hz=self.frequency_hz[rows],
            order=self.order[rows],
            responses=Responses(per_velocity[..., rows], per_load[..., rows], random),
        )

    def row(self, order: int | None) -> IndexArray:
        """Return the numbers of the lines of an order, or of all; empty beyond the highest."""
        everything = np.arange(self.order.size)
        return everything if order is None else everything[self.order == order]

    def weighted(self, order: int | None) -> tuple[IndexArray, WeightedLines]:
        """Return the numbers of the lines that the level of an order or of all depends on.

        Those of an order are all of its gain band, whose energy the gains depend on.
        """
        band = gain_band_number(self.frequency_hz)
        row = self.row(order)
        rows = np.flatnonzero(np.isin(band, band[row])) if self.gains is not None else row
        weight = a_weight(self.frequency_hz[rows])
        weighted = weight if order is None else np.where(np.isin(rows, row), 0.5, 0.0)
        return rows, WeightedLines(weight, weighted, band[rows], order is None, self.gains)


def lines_of(
    speeds_rpm: Sequence[float],
    layouts: Sequence[Layout],
    responses: Sequence[Responses],
    beside: Sequence[tuple[Gains | None, Array | None]] | None = None,
) -> tuple[Lines, ...]:
    """Return the lines of each speed with their responses at the microphones.

    Parameters
    ----------
    speeds_rpm, layouts, responses : speeds, rpm, with their layouts and responses
    beside : gains of a sample and unmodelled noise by speed; none without both
    """
    further = beside or [(None, None)] * len(speeds_rpm)
    each = zip(speeds_rpm, layouts, responses, further, strict=True)
    return tuple(
        Lines(speed, layout.hertz, np.array(layout.order), response, *more)
        for speed, layout, response, more in each
    )


def random_squares(
    random: Sequence[RandomResponse], densities: ComplexArray, sources: int, receivers: int
) -> tuple[Array, Array]:
    """Compute mean squares of random loads, A-weighted and unweighted, Pa².

    Parameters
    ----------
    random : responses to the loads, in the order of the densities
    densities : shape (design or 1, value); see `Probe`
    sources, receivers : number of them

    Returns
    -------
    each of shape (design or 1, source, receiver, gain band)
    """
    weighted = np.zeros((len(densities), sources, receivers, len(GAIN_BANDS)))
    unweighted = np.zeros_like(weighted)
    first = 0
    for load in random:
        lines, pairs, _ = load.per_density.shape
        of_load = densities[:, first : first + lines * pairs].reshape(-1, lines, pairs)
        by_line = (np.swapaxes(of_load, 0, 1) @ load.per_density).real  # (line, design, receiver)
        by_line = np.moveaxis(by_line, 0, -1)
        weighted[:, load.source] += by_line @ load.a_weight
        unweighted[:, load.source] += by_line @ load.member
        first += lines * pairs
    return weighted, unweighted


def noise_of(lines: Lines, arrays: Arrays) -> tuple[Array, Array]:
    """Compute mean squares of random loads at one speed; see `random_squares`.

    Parameters
    ----------
    lines : lines of the speed
    arrays : arrays of the speed: random and load, see `Probe`
    """
    sources = arrays["load"].shape[2]
    return random_squares(lines.responses.random, arrays["random"], sources, lines.receivers)


def seen_of(
    needs: Sequence[Need], lines: Sequence[Lines], by_speed: Sequence[Arrays], body: Arrays, n: int
) -> dict[Need, Array]:
    """Compute the responses of designs, except loudness and audibility.

    Parameters
    ----------
    needs : requested responses
    lines : lines by speed
    by_speed : arrays of each speed, see `Probe`, with the dimension design (or 1) first
    body : arrays of the body, likewise
    n : number of designs
    """
    results: dict[Need, Array] = {}
    for need in needs:
        if need.what == "natural":
            results[need] = _natural_hz(body, by_speed, n)
            continue
        if need in HEARING:
            continue
        parts = [_at_speed(need, *speed, body) for speed in zip(lines, by_speed, strict=True)]
        axis = 2 if need.what == "sound" else 1
        every = [np.broadcast_to(part, (n, *part.shape[1:])) for part in parts]
        results[need] = np.stack(every, axis=axis)
    return results


def spectra_of(
    lines: Sequence[Lines], by_speed: Sequence[Arrays], body: Arrays, n: int
) -> list[Spectrum]:
    """Compute the spectra of designs by speed, with the unmodelled noise; see `seen_of`."""
    each = zip(lines, by_speed, strict=True)
    return [spectrum_of(of_speed, arrays, body, n) for of_speed, arrays in each]


def spectrum_of(lines: Lines, arrays: Arrays, body: Arrays, n: int) -> Spectrum:
    """Compute the spectra of designs at one speed, with the unmodelled noise; see `seen_of`."""
    few = {name: arrays[name] for name in SOUND if name in arrays}
    pressure = pressure_by_source(lines, few, body)
    return heard_spectrum(lines, pressure, *noise_of(lines, arrays), n)


def heard_spectrum(
    lines: Lines, pressure: ComplexArray, noise: Array, thirds: Array, n: int
) -> Spectrum:
    """Return the spectrum of designs at one speed, with the unmodelled noise.

    Parameters
    ----------
    lines : lines of the speed
    pressure, noise, thirds : see `WeightedLines.spectrum`
    n : number of designs
    """
    _, weighted = lines.weighted(None)
    square, random = weighted.spectrum(pressure, noise, thirds)
    if lines.unmodelled is not None:
        random = random + lines.unmodelled
    every = np.broadcast_to(square, (n, *square.shape[1:]))
    return Spectrum(lines.frequency_hz, every, random)


def _natural_hz(body: Arrays, by_speed: Sequence[Arrays], n: int) -> Array:
    if any("added" in arrays and arrays["added"].real.any() for arrays in by_speed):
        raise ParameterError(
            "resonance_margin_ratio: needs mounts of constant stiffness on a rigid floor"
        )
    squares = natural_modes(body["mass"].real, body["stiffness"].real)[0]
    hertz = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
    return np.broadcast_to(hertz, (n, hertz.shape[-1]))


def _at_speed(need: Need, lines: Lines, arrays: Arrays, body: Arrays) -> Array:
    """Compute a response at one speed, shape (design or 1, ...)."""
    if need.what == "figure":
        return reported(arrays, need.name)
    if need.what == "sound":
        return _mean_square(need.order, lines, arrays, body)
    row = lines.row(need.order)
    if not row.size:  # beyond the highest order there is silence
        return np.zeros((1, body["foot"].shape[1]) if need.what == "foot" else 1)
    wrench = arrays["wrench"][:, row[0]]
    if need.what == "foot":
        added = {name: arrays[name] for name in ADDED if name in arrays}
        return size_of_vector(foot_forces(body, added, wrench, lines.frequency_hz, row))
    on_mechanism = wrench.reshape(len(wrench), -1, 6).sum(axis=1)  # no other body is loaded
    return size_of_vector(on_mechanism[:, :3] if need.what == "force" else on_mechanism[:, 3:])


def reported(arrays: Arrays, name: str) -> Array:
    """Return a reported figure, shape (design or 1,); not a number where none has that name."""
    return arrays[name].real if name in arrays else np.full(1, np.nan)


def pressure_by_source(lines: Lines, arrays: Arrays, body: Arrays) -> ComplexArray:
    """Compute the pressure, shape (design or 1, source, receiver, line), complex peak, Pa.

    Parameters
    ----------
    lines : lines of one speed
    arrays : arrays of the speed at these lines: load, shell, factor, added, see `Probe`
    body : arrays of the body
    """
    load = arrays["load"]
    count, size, sources, motions = load.shape
    every = lines.select(np.repeat(np.arange(size), sources))
    added = np.repeat(arrays["added"], sources, axis=1) if "added" in arrays else None
    loads = load.reshape(count, size * sources, motions)
    motion = displacement(body, added, loads, every.frequency_hz)
    rigid = pressure(motion, every.responses.per_velocity, every.frequency_hz)
    total: ComplexArray = rigid.reshape(len(rigid), size, sources, -1)
    if arrays["shell"].size:
        total = total + through_shell(arrays["shell"], lines.responses.per_load)
    total = total * arrays["factor"][..., None, None]
    return np.asarray(np.moveaxis(total, 1, -1))


def through_shell(load: ComplexArray, per_load: ComplexArray) -> ComplexArray:
    """Compute the pressure of loads in the shell, shape (design, line, source, receiver), Pa.

    Parameters
    ----------
    load : loads in the shell, shape (design, line, source, component)
    per_load : pressure per load, Pa/N, shape (receiver, component, line)
    """
    by_line = np.moveaxis(load, 1, 0)
    flat = np.ascontiguousarray(by_line).reshape(len(by_line), -1, load.shape[-1])
    product = flat @ np.ascontiguousarray(np.moveaxis(per_load, -1, 0).swapaxes(1, 2))
    return np.moveaxis(product.reshape(*by_line.shape[:3], -1), 0, 1)


def _mean_square(order: int | None, lines: Lines, arrays: Arrays, body: Arrays) -> Array:
    """Return mean square pressure of all lines or of an order, (design or 1, pair, receiver), Pa².

    All lines are A-weighted, an order is not.
    """
    rows, weighted = lines.weighted(order)
    few = {name: arrays[name][:, rows] for name in SOUND if name in arrays}
    total = pressure_by_source(lines.select(rows), few, body)
    return weighted.mean_square(total, noise_of(lines, arrays)[0])
