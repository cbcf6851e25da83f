"""Balancing by influence coefficients: plain functions on arrays.

A response b of each speed (rows: forces, moments or pressures at the shaft frequency) becomes
b + A u by complex moments u (mass times radius, at an angle) of weights in planes.
"""

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from scipy.optimize import minimize, nnls

from ...base.arrays import Array, ComplexArray, IndexArray
from ...base.errors import SolverError

GAP: Final = 1e-7
"""Difference between the worst speed and its lower bound, of the worst speed, that is accepted."""
_ACTIVE: Final = 1e-5
"""Share of the worst speed's sum of squares within which a speed counts as the worst."""
_NOISE: Final = 1e-24
"""Share of the sum of squares without weights below which what remains is rounding noise."""
_RANK: Final = 1e-9
"""Singular value, of all rows together, below which directions are noise in the lower bound."""
_STEPS: Final = 1000


def sums_of_squares(response: ComplexArray, influence: ComplexArray, moment: ComplexArray) -> Array:
    """Return the sum of squared responses at each speed, shape (speed,).

    Parameters
    ----------
    response : without the weights, shape (speed, row), N, N m or Pa
    influence : response to a unit moment of each weight, shape (speed, row, weight), per kg m
    moment : complex moments of the weights, shape (weight,), kg m
    """
    return np.asarray(np.sum(np.abs(response + influence @ moment) ** 2, axis=1))


def least_squares_moments(response: ComplexArray, influence: ComplexArray) -> ComplexArray:
    """Return the moments with the least sum of squares over all speeds, shape (weight,), kg m.

    Goodman, A least-squares method for computing balance corrections, J. Eng. Ind. 86 (1964) 273,
    equation 6: u = -(AᴴA)⁻¹Aᴴb; the smallest moments where several have the least sum.

    Parameters
    ----------
    response, influence : see `sums_of_squares`
    """
    rows = influence.reshape(-1, influence.shape[-1])
    return np.asarray(np.linalg.lstsq(rows, -response.ravel(), rcond=None)[0], dtype=complex)


def worst_speed_moments(
    response: ComplexArray, influence: ComplexArray, largest: Array | None = None
) -> ComplexArray:
    """Return the moments whose largest sum of squares of any speed is least, (weight,), kg m.

    The problem is convex: least t with |b + A u|² ≤ t at every speed, and |u| ≤ m where moments
    are limited. The result is checked by its dual: for weights λ of the speeds with sum one and
    μ of the limits, min over u of Σ λ |b + A u|² + Σ μ (|u|² - m²) is a lower bound (Boyd and
    Vandenberghe, Convex Optimization, 2004, section 5.2). One speed with all rows gives the
    limited moments of least squares.

    Parameters
    ----------
    response, influence : see `sums_of_squares`
    largest : largest moment of each weight, above zero or infinite, kg m, shape (weight,); none
        for no limit
    """
    start = least_squares_moments(response, influence)
    share = np.zeros(start.size) if largest is None else 1.0 / largest
    within = float(np.max(np.abs(start) * share, initial=0.0))
    start = start / max(within, 1.0)
    residual = response + influence @ start
    size = np.sqrt(sums_of_squares(response, influence, start).max())
    noise = np.sqrt(_NOISE * sums_of_squares(response, influence, 0.0 * start).max())
    if size <= noise or (len(response) == 1 and within <= 1.0):
        return start
    rows = influence.reshape(-1, start.size)
    _, spread, directions = np.linalg.svd(rows, full_matrices=False)
    kept = spread > spread[0] * max(rows.shape) * np.finfo(float).eps
    if not kept.any():
        return start
    basis = (directions[kept].conj() / spread[kept, None]).T  # independent, of one size
    limited = share > 0.0
    bounds = (size * basis * share[:, None])[limited]
    offset = (start * share)[limited]
    scaled = _Scaled(residual / size, influence @ basis, bounds, offset)
    return np.asarray(start + size * basis @ scaled.least_worst(np.zeros(2 * basis.shape[1])))


class _Scaled(NamedTuple):
    """Responses of at most one and influences of independent directions.

    Attributes
    ----------
    response : shape (speed, row)
    influence : shape (speed, row, direction)
    bounds : moments over their limits, shape (limit, direction)
    offset : moments over their limits to begin with, shape (limit,)
    """

    response: ComplexArray
    influence: ComplexArray
    bounds: ComplexArray
    offset: ComplexArray

    def least_worst(self, start: Array) -> ComplexArray:
        """Solve the convex problem from real and imaginary parts to begin with."""
        first = np.append(start, self._sums(start).max())
        solution = minimize(
            lambda x: x[-1],
            first,
            jac=lambda x: np.eye(x.size)[-1],
            constraints={
                "type": "ineq",
                "fun": lambda x: -self._excess(x[:-1], x[-1]),
                "jac": lambda x: np.column_stack([-self._slopes(x[:-1]), self._is_speed]),
            },
            method="SLSQP",
            options={"maxiter": _STEPS, "ftol": 1e-16},
        )
        parts = solution.x[:-1]
        worst = float(self._sums(parts).max())
        gap = worst - self._bound(parts)
        if gap > GAP * max(worst, np.finfo(float).eps / GAP):
            raise SolverError(f"balancing: the worst speed is known to {gap / worst:.1g} only")
        return _complex(parts)

    def _sums(self, parts: Array) -> Array:
        return sums_of_squares(self.response, self.influence, _complex(parts))

    @property
    def _is_speed(self) -> Array:
        """One for each speed, then zero for each limit."""
        return np.append(np.ones(len(self.response)), np.zeros(len(self.bounds)))

    def _excess(self, parts: Array, worst: float) -> Array:
        """Sums of squares above the worst, then squared moments above their limits."""
        squared = np.abs(self.offset + self.bounds @ _complex(parts)) ** 2
        return np.append(self._sums(parts) - worst, squared - 1.0)

    def _slopes(self, parts: Array) -> Array:
        """Slopes of the sums of squares and of squared moments, shape (speed + limit, part)."""
        moment = _complex(parts)
        residual = self.response + self.influence @ moment
        slope = 2.0 * np.einsum("sr,srw->sw", residual.conj(), self.influence)
        further = 2.0 * (self.offset + self.bounds @ moment).conj()[:, None] * self.bounds
        slope = np.concatenate([slope, further])
        return np.concatenate([slope.real, -slope.imag], axis=1)

    def _bound(self, parts: Array) -> float:
        """Lower bound of the worst speed, by the weights that balance the slopes best."""
        worst = self._sums(parts).max()
        active = self._excess(parts, worst) >= -_ACTIVE * np.append(
            np.full(len(self.response), worst), np.ones(len(self.bounds))
        )
        rows = np.vstack([self._slopes(parts).T, self._is_speed])
        weight = np.zeros(active.size)
        weight[active], _ = nnls(rows[:, active], np.eye(len(rows))[-1])
        root = np.sqrt(weight / (weight @ self._is_speed))
        speeds, limits = np.split(root, [len(self.response)])
        influence = (speeds[:, None, None] * self.influence).reshape(-1, self.influence.shape[-1])
        stacked = np.concatenate([influence, limits[:, None] * self.bounds])
        response = np.append((speeds[:, None] * self.response).ravel(), limits * self.offset)
        smallest = _RANK / max(float(np.linalg.norm(stacked)), _RANK)
        best = -np.linalg.pinv(stacked, rcond=smallest) @ response
        return float(np.sum(np.abs(response + stacked @ best) ** 2) - np.sum(limits**2))


def _complex(parts: Array) -> ComplexArray:
    real, imaginary = np.split(parts, 2)
    return np.asarray(real + 1j * imaginary)


def chosen_moments(
    response: ComplexArray, influence: ComplexArray, positions: Sequence[ComplexArray]
) -> IndexArray:
    """Return the position of each weight with the least worst speed, numbers of shape (weight,).

    Branch and bound by a QR decomposition of each speed (sphere decoding: Agrell and others, IEEE
    Trans. Inf. Theory 48 (2002) 2201): the sum of squares is a sum over rows of a triangular
    matrix, each of which depends on the weights chosen so far. It finds what trying all finds.

    Parameters
    ----------
    response, influence : see `sums_of_squares`
    positions : complex moments that each weight may have, such as those of its bolt holes, kg m
    """
    factors = [np.linalg.qr(item) for item in influence]
    turned = [q.conj().T @ item for (q, _), item in zip(factors, response, strict=True)]
    constant = np.sum(np.abs(response) ** 2, axis=1) - [
        np.sum(np.abs(item) ** 2) for item in turned
    ]
    search = _Search(
        np.array(turned), np.array([r for _, r in factors]), positions, np.maximum(constant, 0.0)
    )
    return search.best()


class _Node(NamedTuple):
    """Some weights in their positions, the last ones of all.

    Attributes
    ----------
    bound : least worst speed with these positions
    numbers : number of the position of each weight
    response : turned, with these weights, shape (speed, row)
    sums : sum of squares that no other weight changes, shape (speed,)
    """

    bound: float
    numbers: tuple[int, ...]
    response: ComplexArray
    sums: Array


class _Search(NamedTuple):
    """Search for the positions of weights, the last weight first.

    Attributes
    ----------
    turned : response, shape (speed, row)
    triangle : upper triangular influence, shape (speed, row, weight)
    positions : moments that each weight may have
    constant : sum of squares that no weight changes, shape (speed,)
    """

    turned: ComplexArray
    triangle: ComplexArray
    positions: Sequence[ComplexArray]
    constant: Array

    def best(self) -> IndexArray:
        """Search depth first, the most promising positions first."""
        weights = self.triangle.shape[-1]
        best, chosen = np.inf, tuple([0] * weights)
        pending = [_Node(float(self.constant.max()), (), self.turned, self.constant)]
        while pending:
            bound, numbers, response, sums = pending.pop()
            if bound >= best:
                continue
            if len(numbers) == weights:
                best, chosen = bound, numbers
                continue
            number = weights - len(numbers) - 1
            candidates = (
                response + self.triangle[:, :, number] * self.positions[number][:, None, None]
            )
            further = np.broadcast_to(sums, (len(candidates), len(sums)))
            if number < self.triangle.shape[1]:
                further = further + np.abs(candidates[:, :, number]) ** 2
            bounds = further.max(axis=1)
            pending += [
                _Node(float(bounds[row]), (row, *numbers), candidates[row], further[row])
                for row in np.argsort(-bounds, kind="stable").tolist()
                if bounds[row] < best
            ]
        return np.array(chosen, dtype=np.intp)
