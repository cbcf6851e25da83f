"""A mode that is known at nodes only: measured, or computed elsewhere."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Final

import numpy as np
from scipy.interpolate import RBFInterpolator

from ...base.arrays import Array
from ...base.errors import ParameterError
from ...machine.shell_structure import Joint
from .loads import joint_forces

_NEIGHBOURS: Final = 12
"""Nodes that a point is interpolated between."""


@dataclass(frozen=True)
class SampledMode:
    """A natural mode given at nodes; its amplitude is that of the shape as it is scaled.

    Attributes
    ----------
    name : name of the mode
    frequency_hz : natural frequency
    modal_mass_kg : modal mass of the shape with its scale
    nodes_m : places about the centre of mass, shape (node, 3)
    shape : displacements, shape (node, 3)
    """

    name: str
    frequency_hz: float
    modal_mass_kg: float
    nodes_m: Array
    shape: Array

    def __post_init__(self) -> None:
        nodes = np.asarray(self.nodes_m)
        if nodes.ndim != 2 or nodes.shape[1] != 3 or nodes.shape != np.shape(self.shape):
            raise ParameterError(
                f"mode {self.name}: nodes {nodes.shape} and shape {np.shape(self.shape)}: both "
                "must be (node, 3)"
            )
        if np.unique(nodes, axis=0).shape != nodes.shape:
            raise ParameterError(f"mode {self.name}: two nodes have the same place")

    def velocity(self, points: Array) -> Array:
        """Velocity vectors of surface points per unit of the mode's velocity, shape (point, 3).

        Between the nodes by radial basis functions |r|, which are exact at the nodes.

        Parameters
        ----------
        points : x, y, z about the centre of mass, shape (point, 3), m
        """
        return np.asarray(self._interpolator(points))

    def modal_forces(self, joint: Joint, radius_m: float) -> Array:
        """Generalised force per unit load `JOINT_LOADS` of a joint, shape (load,).

        Parameters
        ----------
        joint : welds
        radius_m : radius of the wall
        """
        points, forces = joint_forces(joint, radius_m)
        return np.asarray(np.einsum("pi,pil->l", self.velocity(points), forces))

    @cached_property
    def _interpolator(self) -> Any:
        neighbours = min(_NEIGHBOURS, len(self.nodes_m))
        return RBFInterpolator(
            self.nodes_m, self.shape, neighbors=neighbours, kernel="linear", degree=0
        )
