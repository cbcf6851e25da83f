"""Designs that all stand on the same mounts: sound is a sum of squares of a few sums."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array
from .expansion import Expansion, summed
from .on_mounts import Arrays, Lines, seen_of
from .response import a_weight, displacement, pressure
from .seen import Need

RANK: Final = 1e-13
"""Of the largest singular value: what is smaller is rounding."""
SOLVED: Final = ("mass", "stiffness", "foot", "added", "foot_added", "factor")
"""Arrays that must be the same for all designs."""
BY_LINE: Final = ("wrench", "added", "foot_added")


def is_fixed(by_speed: Sequence[Expansion], body: Expansion) -> bool:
    """Whether all designs stand on the same mounts, behind the same hood."""
    return all(
        name not in part.factors or part.is_constant(name)
        for part in (*by_speed, body)
        for name in SOLVED
    )


@dataclass(frozen=True)
class FixedSpeed:
    """One speed of designs on the same mounts, prepared for what is asked.

    Attributes
    ----------
    lines : those of the orders that are asked for but as sound
    arrays : expansion of what is no sound, at these lines
    noise : factors of the random loads, shape (product, receiver)
    """

    lines: Lines
    arrays: Expansion
    noise: Array

    @classmethod
    def of(cls, needs: Sequence[Need], lines: Lines, arrays: Expansion) -> "FixedSpeed":
        """Prepared for what is asked."""
        orders = {need.order for need in needs if need.what in ("force", "moment", "foot")}
        rows = np.array([row for order in orders for row in lines.row(order)], dtype=np.intp)
        figures = {need.name for need in needs if need.what == "figure"}
        factors = arrays.factors
        few = {name: factors[name][:, rows] for name in BY_LINE if name in factors}
        few |= {name: factors[name] for name in figures if name in factors}
        few = {name: part for name, part in few.items() if name in figures or rows.size}
        expansion = Expansion(arrays.terms, arrays.speed_rpm, few)
        return cls(lines.at(rows), expansion, factors["noise"].real)


def compressed(order: int | None, lines: Lines, arrays: Expansion, body: Arrays) -> Array:
    """Rows by receiver, (receiver, row, product): squares of their sums are the mean square.

    All lines of a receiver are linear in the products of the variables: real and imaginary parts
    of every line, weighed, are a matrix A, and |A g|² = |S Vᵀ g|² by its singular values, as few
    as there are independent products.

    Parameters
    ----------
    order : of the sound; none for all of it, A-weighted
    lines : of the speed
    arrays : their expansion
    body : mass and stiffness of all designs, shape (1, ...)
    """
    rows, factors = lines.row(order), arrays.factors
    part = lines.at(rows)
    added = factors["added"][:1, rows] if "added" in factors else None
    motion = displacement(body, added, factors["load"][:, rows], part.frequency_hz)
    total = pressure(motion, part.per_velocity, part.frequency_hz) + factors["other"][:, rows]
    weight = a_weight(part.frequency_hz) if order is None else np.full(rows.size, 0.5)
    total = total * (np.sqrt(weight) * factors["factor"][0, rows])[:, None]
    both = np.concatenate([total.real, total.imag], axis=1)  # (product, 2 lines, receiver)
    return _squeezed(np.moveaxis(both, (2, 1, 0), (0, 1, 2)))


def _squeezed(matrices: Array) -> Array:
    """S Vᵀ of each matrix, shape (receiver, rank, product)."""
    _, sizes, directions = np.linalg.svd(matrices, full_matrices=False)
    largest = max(float(sizes.max(initial=0.0)), 1e-300)
    rank = max(int((sizes > RANK * largest).any(axis=0).sum()), 1)
    return np.asarray((sizes[..., None] * directions)[:, :rank])


@dataclass(frozen=True)
class FixedMounts:
    """Designs on the same mounts, computed by a few sums each.

    Attributes
    ----------
    speeds : each of them
    body : mass, stiffness and foot, shape (1, ...)
    sums : of the products that all sound is made of, shape (sum, product)
    sound : by need, rows of these sums, whose own sums make the mean square, shape
        (speed, receiver, row, sum)
    """

    speeds: tuple[FixedSpeed, ...]
    body: Arrays
    sums: Array
    sound: dict[Need, Array]

    @classmethod
    def of(
        cls,
        needs: Sequence[Need],
        lines: Sequence[Lines],
        by_speed: Sequence[Expansion],
        body: Expansion,
    ) -> "FixedMounts":
        """Prepared for what is asked."""
        bare = {name: factors[:1] for name, factors in body.factors.items()}
        both = list(zip(lines, by_speed, strict=True))
        speeds = tuple(FixedSpeed.of(needs, *one) for one in both)
        rows = {
            need: _stacked([compressed(need.order, *one, bare) for one in both])
            for need in needs
            if need.what == "sound"
        }
        nothing = np.zeros((1, len(by_speed[0].terms.products)))
        sums = _directions(np.concatenate([nothing, *map(_scaled, rows.values())]))
        return cls(speeds, bare, sums, {need: part @ sums.T for need, part in rows.items()})

    def seen(self, needs: Sequence[Need], values: Array) -> dict[Need, Array]:
        """What is seen of designs.

        Parameters
        ----------
        needs : among those that it was prepared for
        values : shape (design, variable)
        """
        by_speed = self._columns(values)
        others = [need for need in needs if need.what != "sound"]
        arrays = [
            {name: summed(columns, factors) for name, factors in one.arrays.factors.items()}
            for one, columns in zip(self.speeds, by_speed, strict=True)
        ]
        lines = [one.lines for one in self.speeds]
        seen = seen_of(others, lines, arrays, self.body, len(values))
        sounds = [need for need in needs if need.what == "sound"]
        return seen | {need: self._sound(need, by_speed) for need in sounds}

    def _columns(self, values: Array) -> list[Array]:
        """Products of the variables by speed, once where they are the same at all."""
        first, *rest = self.speeds
        columns = first.arrays.terms.at(values, first.lines.speed_rpm)
        if not first.arrays.terms.by_speed:
            return [columns] * len(self.speeds)
        return [columns, *(one.arrays.terms.at(values, one.lines.speed_rpm) for one in rest)]

    def _sound(self, need: Need, by_speed: Sequence[Array]) -> Array:
        """Mean square, shape (design, speed, receiver)."""
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
        return square


def _stacked(parts: Sequence[Array]) -> Array:
    """Rows of all speeds, those of fewer filled with zeros, (speed, receiver, row, product)."""
    most = max(part.shape[1] for part in parts)
    return np.stack([np.pad(part, ((0, 0), (0, most - part.shape[1]), (0, 0))) for part in parts])


def _directions(rows: Array) -> Array:
    """As few independent sums as all rows are made of, shape (sum, product)."""
    _, sizes, directions = np.linalg.svd(rows, full_matrices=False)
    return np.asarray(directions[: max(int((sizes > RANK * sizes[0]).sum()), 1)])


def _scaled(rows: Array) -> Array:
    """Rows of each speed and receiver over their largest, so that quiet ones count as loud ones."""
    size = np.abs(rows).max(axis=(2, 3), keepdims=True)
    scaled = rows / np.where(size > 0.0, size, 1.0)
    return np.asarray(scaled.reshape(-1, rows.shape[-1]))
