"""Gauss-Legendre quadrature in panels, with the integral up to every node."""

from dataclasses import dataclass
from typing import Final

import numpy as np

from ...base.arrays import Array

NODES: Final = 4
"""Nodes of one panel: exact for a polynomial of degree 7 over it, of degree 3 inside it."""


@dataclass(frozen=True)
class GaussPanels:
    """Panels between given edges; kinks of the integrand belong on edges.

    Attributes
    ----------
    edges : rising, shape (panel + 1,)
    """

    edges: Array

    @property
    def nodes(self) -> Array:
        """Shape (panel × node,)."""
        positions, _, _ = _rule()
        return np.asarray(self.edges[:-1, None] + self._width * positions).ravel()

    def integral(self, values: Array) -> float:
        """Over all panels.

        Parameters
        ----------
        values : at the nodes
        """
        return float(self.running(values)[1][-1])

    def running(self, values: Array) -> tuple[Array, Array]:
        """Integrals from the first edge to every node and to every edge.

        Parameters
        ----------
        values : at the nodes
        """
        _, weights, inner = _rule()
        scaled = self._width * values.reshape(-1, NODES)
        edges = np.concatenate([[0.0], np.cumsum(scaled @ weights)])
        return (edges[:-1, None] + scaled @ inner.T).ravel(), edges

    @property
    def _width(self) -> Array:
        return np.diff(self.edges)[:, None]


def _rule() -> tuple[Array, Array, Array]:
    """Nodes on 0 to 1, weights over all of it, and from zero to each node (node, node)."""
    points, weights = np.polynomial.legendre.leggauss(NODES)
    positions = 0.5 * (points + 1.0)
    powers = np.arange(NODES)
    # Integrates every power exactly: inner @ position^k = position^(k+1) / (k+1).
    vandermonde = positions[:, None] ** powers
    integrals = positions[:, None] ** (powers + 1) / (powers + 1)
    return positions, 0.5 * weights, integrals @ np.linalg.inv(vandermonde)
