"""Critical speeds of a shaft in round bearings, and the thesis's estimate from a deflection."""

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Final

import numpy as np
from scipy.linalg import eigh

from ..base.arrays import Array
from ..base.constants import STANDARD_GRAVITY_M_PER_S2
from .beam_rotor import NODE_DOFS, RotorMatrices, Section, assemble, with_disc, with_ring
from .scroll_shaft import ScrollShaft

ELEMENT_LENGTH_M: Final = 0.01
"""Ten elements or more over half a wave of the highest mode of interest."""
_ROUNDING: Final = 1e-6
"""Share of an element's length below which a span counts as zero."""


def rule_of_thumb_rpm(deflection_cm: float) -> float:
    """n_c = 300/√y[cm], thesis eq. (6.2): √(g/y) rounded up from 299.04 rpm √cm.

    It holds for y the sag under the shaft's own weight, which stands for its stiffness. The
    thesis puts in the deflection y = e ω²/(ω_c² - ω²) under the centrifugal force instead: that
    grows with the unbalance's radius e and the speed squared, so "n_c" falls with the speed.
    """
    return float(300.0 / np.sqrt(deflection_cm))


def on_bearings(rotor: RotorMatrices, nodes: Array, stiffness_n_per_m: float) -> RotorMatrices:
    """The rotor with springs in x and y at nodes."""
    stiffness = rotor.stiffness.copy()
    for node in nodes:
        dof = NODE_DOFS * int(node)
        stiffness[[dof, dof + 1], [dof, dof + 1]] += stiffness_n_per_m
    return replace(rotor, stiffness=stiffness)


def forward_critical_speeds(rotor: RotorMatrices) -> Array:
    """Speeds at which unbalance is in resonance, rad/s, ascending.

    Forward circular whirl at the speed of rotation: K v = Ω² (M - jG) v on x = v, y = -jv. A disc
    thicker than long (I_p > I_d) makes M - jG indefinite; its negative roots are no speeds.

    Parameters
    ----------
    rotor : alike in both planes, on its bearings
    """
    node = np.array([[1.0, 0.0], [-1j, 0.0], [0.0, 1j], [0.0, 1.0]])  # x, y, θx, θy
    forward = np.kron(np.eye(len(rotor.mass) // NODE_DOFS), node)
    stiffness, mass = (
        (forward.conj().T @ matrix @ forward).real
        for matrix in (rotor.stiffness, rotor.mass - 1j * rotor.gyroscopic)
    )
    inverse_squares = eigh(mass, stiffness, eigvals_only=True)
    rounding = np.finfo(float).eps * len(mass) * np.max(np.abs(inverse_squares))
    return np.asarray(1.0 / np.sqrt(inverse_squares[inverse_squares > rounding][::-1]))


@dataclass(frozen=True)
class FreeShaft:
    """The scroll compressor's shaft without its bearings and without what the pin carries.

    Attributes
    ----------
    rotor : beam with the motor's rotor, whose mass is spread over its length
    heights_m : heights of the nodes above the lower bearing, the first one's, shape (node,)
    main_node, pin_node : at the main bearing and at the crank pin
    bearing_stiffness_n_per_m : bearing stiffness of each bearing
    """

    rotor: RotorMatrices
    heights_m: Array
    main_node: int
    pin_node: int
    bearing_stiffness_n_per_m: float


def free_scroll_shaft(shaft: ScrollShaft, element_length_m: float = ELEMENT_LENGTH_M) -> FreeShaft:
    """Beam model of the scroll compressor's shaft, free.

    Parameters
    ----------
    shaft : sizes, rotor, bearings
    element_length_m : at most
    """
    bottom = shaft.rotor_height_m - 0.5 * shaft.rotor_length_m
    ring = bottom, bottom + shaft.rotor_length_m
    fixed = np.array([0.0, *ring, shaft.main_bearing_height_m, shaft.length_m])
    nodes = _nodes(fixed, element_length_m)
    section = Section(shaft.diameter_m, shaft.youngs_modulus_pa, shaft.density_kg_per_m3)
    diameters = shaft.diameter_m, shaft.rotor_diameter_m
    rotor = with_ring(assemble(section, nodes), nodes, ring, shaft.rotor_mass_kg, diameters)
    main = _node_at(nodes, shaft.main_bearing_height_m)
    return FreeShaft(rotor, nodes, main, nodes.size - 1, shaft.bearing_stiffness_n_per_m)


def scroll_shaft_rotor(shaft: ScrollShaft) -> RotorMatrices:
    """Beam model of the scroll compressor's shaft on its two bearings."""
    free = free_scroll_shaft(shaft)
    rotor = with_disc(free.rotor, free.pin_node, shaft.pin_mass_kg, 0.0, 0.0)
    return on_bearings(rotor, np.array([0, free.main_node]), shaft.bearing_stiffness_n_per_m)


def sag_under_weight_m(rotor: RotorMatrices) -> Array:
    """Sag of each node of a rotor whose weight acts along x, m, for the rule of thumb.

    Parameters
    ----------
    rotor : on its bearings
    """
    weight = np.zeros(len(rotor.mass))
    weight[::NODE_DOFS] = STANDARD_GRAVITY_M_PER_S2
    sag = np.linalg.solve(rotor.stiffness, rotor.mass @ weight)
    return np.asarray(sag[::NODE_DOFS])


def _nodes(fixed: Array, element_length_m: float) -> Array:
    """Nodes at the given places and no farther apart than an element's length."""
    spans = [
        np.linspace(
            start, end, int(np.ceil((end - start) / element_length_m - _ROUNDING)), endpoint=False
        )
        for start, end in pairwise(fixed)
    ]
    return np.append(np.concatenate(spans), fixed[-1])


def _node_at(nodes: Array, height: float) -> int:
    return int(np.argmin(np.abs(nodes - height)))
