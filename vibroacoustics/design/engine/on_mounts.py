"""What is seen of designs whose arrays are known: each moves on its mounts."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.errors import ParameterError
from .response import a_weight, displacement, foot_force, natural_modes, pressure, size_of_vector
from .seen import Need
from .sound_way import SoundWay

Arrays = Mapping[str, ComplexArray]
ADDED = ("added", "foot_added")


@dataclass(frozen=True)
class Lines:
    """Lines of one speed.

    Attributes
    ----------
    speed_rpm : of the shaft
    frequency_hz, order : shape (line,); order 0 for tones that are none
    per_velocity : pressure per velocity, shape (receiver, 6, line), Pa s/m
    """

    speed_rpm: float
    frequency_hz: Array
    order: IndexArray
    per_velocity: ComplexArray

    def at(self, rows: IndexArray) -> "Lines":
        """Some of the lines."""
        return Lines(
            self.speed_rpm, self.frequency_hz[rows], self.order[rows], self.per_velocity[..., rows]
        )

    def row(self, order: int | None) -> IndexArray:
        """Numbers of the lines of an order, or of all; empty beyond the highest."""
        everything = np.arange(self.order.size)
        return everything if order is None else everything[self.order == order]


def lines_of_speed(
    speed_rpm: float, frequency_hz: Array, order: IndexArray, way: SoundWay
) -> Lines:
    """Lines of one speed on their way to the microphones."""
    return Lines(speed_rpm, frequency_hz, order, way.per_velocity(frequency_hz))


def seen_of(
    needs: Sequence[Need], lines: Sequence[Lines], by_speed: Sequence[Arrays], body: Arrays, n: int
) -> dict[Need, Array]:
    """What is seen of designs.

    Parameters
    ----------
    needs : what is asked
    lines : by speed
    by_speed : arrays of each speed, see `Probe`, with the dimension design (or 1) first
    body : arrays of the body, likewise
    n : number of designs
    """
    seen: dict[Need, Array] = {}
    for need in needs:
        if need.what == "natural":
            seen[need] = _natural_hz(body, by_speed, n)
            continue
        parts = [_at_speed(need, *speed, body) for speed in zip(lines, by_speed, strict=True)]
        seen[need] = np.stack([np.broadcast_to(p, (n, *p.shape[1:])) for p in parts], axis=1)
    return seen


def _natural_hz(body: Arrays, by_speed: Sequence[Arrays], n: int) -> Array:
    if any("added" in arrays and arrays["added"].real.any() for arrays in by_speed):
        raise ParameterError(
            "resonance_margin_ratio: needs mounts of constant stiffness on a rigid floor"
        )
    squares = natural_modes(body["mass"].real, body["stiffness"].real)[0]
    hertz = np.sqrt(np.maximum(squares, 0.0)) / (2.0 * np.pi)
    return np.broadcast_to(hertz, (n, hertz.shape[-1]))


def _at_speed(need: Need, lines: Lines, arrays: Arrays, body: Arrays) -> Array:
    """At one speed, shape (design or 1, ...)."""
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
        return foot_force(body, added, wrench, lines.frequency_hz, row)
    on_mechanism = wrench.reshape(len(wrench), -1, 6).sum(axis=1)  # no other body is loaded
    return size_of_vector(on_mechanism[:, :3] if need.what == "force" else on_mechanism[:, 3:])


def reported(arrays: Arrays, name: str) -> Array:
    """A reported figure, shape (design or 1,); not a number where there is none of that name."""
    return arrays[name].real if name in arrays else np.full(1, np.nan)


def _mean_square(order: int | None, lines: Lines, arrays: Arrays, body: Arrays) -> Array:
    """Of the pressure, shape (design or 1, receiver), Pa²: A-weighted of all, plain of an order."""
    row = lines.row(order)
    part = lines.at(row)
    added = arrays["added"][:, row] if "added" in arrays else None
    motion = displacement(body, added, arrays["load"][:, row], part.frequency_hz)
    total = pressure(motion, part.per_velocity, part.frequency_hz) + arrays["other"][:, row]
    weight = a_weight(part.frequency_hz) if order is None else np.full(row.size, 0.5)
    factor = weight * np.abs(arrays["factor"][:, row]) ** 2
    square = np.einsum("nlr,nl->nr", np.abs(total) ** 2, np.broadcast_to(factor, total.shape[:2]))
    return np.asarray(square + arrays["noise"].real if order is None else square)
