"""Gas forces on the two scrolls over crank angle: an internal pair, and what the shaft feels."""

from dataclasses import dataclass

import numpy as np

from ...base.arrays import Array
from ...mechanics.moving_parts import path
from .parameters import ScrollGas, ScrollWraps, area_inside, contact_angle, contact_count
from .suction import OpenedGas, pocket_pressure


@dataclass(frozen=True)
class ScrollGasCycle:
    """Gas forces over crank angle, on the orbiting scroll and, equal and opposite, on the fixed.

    Each acts along one line through the point half way between the axes of the two scrolls, as
    the pockets come in pairs that lie opposite about it.

    Attributes
    ----------
    crank_angle : angle of the crank pin from x, shape (samples,), rad
    orbit_radius_m : radius of the orbiting scroll's circle
    tangential_force_n : against the motion of the orbiting scroll, shape (samples,)
    radial_force_n : towards the axis of the fixed scroll, apart from the flanks' contacts, shape
        (samples,)
    axial_force_n : parts the plates of the scrolls, over suction pressure on their backs, shape
        (samples,)
    port_flow_kg_per_s : gas through the discharge port, shape (samples,); none where pockets open
        by an angle
    """

    crank_angle: Array
    orbit_radius_m: float
    tangential_force_n: Array
    radial_force_n: Array
    axial_force_n: Array
    port_flow_kg_per_s: Array | None = None

    @property
    def on_orbiting_scroll_n(self) -> Array:
        """x, y, z in the machine's frame, fixed scroll above, shape (3, samples)."""
        cosine, sine = np.cos(self.crank_angle), np.sin(self.crank_angle)
        tangential, radial = self.tangential_force_n, self.radial_force_n
        x = tangential * sine - radial * cosine
        y = -tangential * cosine - radial * sine
        return path(x, y, -self.axial_force_n)

    @property
    def on_fixed_scroll_n(self) -> Array:
        """Equal and opposite, on the same lines, shape (3, samples)."""
        return -self.on_orbiting_scroll_n

    @property
    def line_of_action_m(self) -> Array:
        """Point that the forces pass through, x and y from the shaft's axis, shape (2, samples)."""
        half = 0.5 * self.orbit_radius_m
        return half * np.stack([np.cos(self.crank_angle), np.sin(self.crank_angle)])

    @property
    def torque_n_m(self) -> Array:
        """F_t r_o that the shaft needs against the gas; the gas turns it with -1 times this."""
        return self.tangential_force_n * self.orbit_radius_m

    @property
    def self_rotation_moment_n_m(self) -> Array:
        """M_z = F_t r_o/2 about the orbiting scroll's own axis, in the sense of the shaft.

        The keys of the Oldham ring bear it, which is their preload.
        """
        return 0.5 * self.torque_n_m


def scroll_gas_cycle(
    wraps: ScrollWraps, gas: ScrollGas, crank_angle: Array, opened: OpenedGas | None = None
) -> ScrollGasCycle:
    """Gas forces of the pressure steps at the contacts, in closed form.

    F_t = 2 r_b h Σ Δp t, F_r = 2 r_b h Σ Δp, F_z = Σ Δp A(t): the half turn of wrap between the
    two contacts of a pair has the chord 2 r_b t along the crank and 2 r_b across it. Δp is the
    pressure inside less that outside the contact at the contact angle t.

    A suction pocket ends where the wraps do: its pressure over that outside acts on flanks and
    plates from its contact to there, see `_of_suction_pockets`.

    A sample on the opening of a pocket counts as open. The step there lies between two samples,
    so an order is right to about the step of the force over the number of samples.

    Parameters
    ----------
    wraps : geometry
    gas : pressures and polytropic index
    crank_angle : shape (samples,), rad
    opened : gas after the opening, of the law `inertia`; none for the equalisation angle
    """
    turn = 2.0 * np.pi
    count = contact_count(wraps, gas.equalisation_angle_rad if opened is None else np.pi)
    since_closing = np.mod(crank_angle - wraps.closing_crank_angle_rad, turn)
    inner_angle = since_closing + turn * np.arange(count)[:, None]
    inner, outer = (
        pocket_pressure(wraps, gas, angle, opened) for angle in (inner_angle, inner_angle - turn)
    )
    step = inner - outer
    contact = contact_angle(wraps, inner_angle)
    width = 2.0 * wraps.base_radius_m * wraps.height_m
    forces = np.stack([
        np.sum(width * step * contact, axis=0),
        np.sum(width * step, axis=0),
        np.sum(step * area_inside(wraps, contact), axis=0),
    ])  # fmt: skip
    if opened is not None and opened.filling is not None:
        overpressure = outer[0] - gas.suction_pressure_pa
        forces += overpressure * _of_suction_pockets(wraps, since_closing)
    return ScrollGasCycle(
        crank_angle=crank_angle,
        orbit_radius_m=wraps.orbit_radius_m,
        tangential_force_n=forces[0],
        radial_force_n=forces[1],
        axial_force_n=forces[2],
        port_flow_kg_per_s=None if opened is None else _port_flow(wraps, opened, since_closing),
    )


def _of_suction_pockets(wraps: ScrollWraps, since_closing: Array) -> Array:
    """Tangential, radial and axial force per pressure over suction at the pockets' open ends, m².

    From ∫ 2 r_b h t e^{jt} dt over the flanks of the two pockets, from their contacts at t_c to
    their ends at t_e = t_c + φ; -dV/dφ of both over the orbit radius is the tangential one.
    """
    end = float(contact_angle(wraps, np.zeros(())))
    cosine, sine = np.cos(since_closing), np.sin(since_closing)
    width = 2.0 * wraps.base_radius_m * wraps.height_m
    swept_area = 2.0 * wraps.base_radius_m * wraps.orbit_radius_m * (1.0 - cosine - end * sine)
    return np.stack([
        width * (end * cosine - sine),
        width * (cosine + end * sine),
        area_inside(wraps, np.asarray(end)) + swept_area,
    ])  # fmt: skip


def _port_flow(wraps: ScrollWraps, opened: OpenedGas, since_closing: Array) -> Array:
    since_opening = np.mod(since_closing - wraps.opening_angle_rad, 2.0 * np.pi)
    flow = np.interp(since_opening, opened.since_opening, opened.port_flow_kg_per_s)
    return np.asarray(flow)
