"""Joining the machine side and the room side on the box by reciprocity."""

from .arrays import ComplexArray
from .box import Box, BoxField


def join(box: Box, near: BoxField, green: BoxField) -> ComplexArray:
    """Sound pressure at the point of which `green` is the Green's function, shape (frequency,).

    Kirchhoff-Helmholtz integral over the box, with the normal n out of the box (towards the
    receiver): p = integral of [p dG/dn - G dp/dn] dS (Pierce, Acoustics (2019), section 4.6).
    With p and G half a cell inside (i) and outside (o) of every face of area A, a distance d apart,
    the central differences and means combine to

        p = sum of A/d (p_i G_o - p_o G_i),

    which no choice of box changes as long as both fields obey the discrete equations. So a rocking
    body's weak sound is not drowned by quadrature errors of its strong near field.
    """
    pressure: ComplexArray = (near.inner * green.outer - near.outer * green.inner) @ box.weights
    return pressure
