"""Forces between keys and slots over steady revolutions at constant speed."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.interpolate import CubicSpline

from ...base.arrays import Array
from ...base.curves import Curve, CurveAxis, angle_axis
from ...base.errors import ParameterError, SolverError
from ...base.units import shaft_frequency_hz
from ...mechanics.rotation import uniform_crank_angle
from .contact import OldhamKeys, contact_mass_kg, key_face
from .equations import COORDINATES, KEYS, Coupling
from .integration import SPEED, integrate

SETTLING_REVOLUTIONS: Final = 4
"""Revolutions omitted after the start, which has the keys midway in the slots. At rated load, at
all corners of the assumed ranges, forces are then within 2e-8 N of those after ten."""
REPEATED: Final = 1e-4
"""Change of forces from one revolution to the next, of the largest, below which they repeat; the
one that follows is a fifth of it or less. A tenth of it changes no level by more than 0.003 dB."""
SAMPLE_RATE_HZ: Final = 1e5
"""Least sample rate; of an unloaded ring's 14 N rms at 3500 rpm 0.13 N rms lie above 32 kHz."""
MOST_STEPS: Final = 1000
"""Most steps between two samples; some seven are usual."""
STEP_RATIO: Final = 0.2
"""Step times the highest angular frequency of contact; a dry rebound is then right to 0.001 in the
mean and to 0.01 whatever the phase of the steps."""
LOADED_STEP_RATIO: Final = 1.0
"""Likewise where no key leaves its face; 0.6 in its place changes no level by 0.0005 dB, 0.2 none
by more than 0.03 dB."""
START_SPEED_M_PER_S: Final = 0.05
"""Largest speed of a key across its slot by each coordinate where the start is random."""
STICKING_SPEED_M_PER_S: Final = 2e-3
"""Friction grows as tanh of sliding speed over this one; at rated load a quarter of it
changes no peak by more than 0.2 N. The ring slides at up to 1.3 m/s at 3500 rpm."""
KEY_NAMES: Final = (
    "in the scroll, y > 0",
    "in the scroll, y < 0",
    "in the housing, x > 0",
    "in the housing, x < 0",
)
SOURCE: Final = "four keys with clearance, film and friction, our equations"


@dataclass(frozen=True)
class KeyForces:
    """Forces between keys and slots over whole revolutions from crank angle zero.

    Keys 0 and 1 are in the scroll's slots, at y = ±R of the ring; 2 and 3 in the housing's, at
    x = ±R.

    Attributes
    ----------
    speed_rpm : speed of the shaft, constant
    revolutions : their number
    normal_n : force on each key across its slot, shape (4, samples); along x for keys 0 and 1,
        along y for 2 and 3
    friction_n : force on each key along its slot, shape (4, samples)
    impacts : 1 where a key met a face in the interval before, otherwise 0, shape (4, samples)
    """

    speed_rpm: float
    revolutions: int
    normal_n: Array
    friction_n: Array
    impacts: Array

    @property
    def sample_rate_hz(self) -> float:
        per_revolution = self.normal_n.shape[-1] / self.revolutions
        return per_revolution * shaft_frequency_hz(self.speed_rpm)

    @property
    def time_s(self) -> Array:
        """Shape (samples,); crank angle zero at time 0."""
        return np.arange(self.normal_n.shape[-1]) / self.sample_rate_hz

    @property
    def crank_angle(self) -> Array:
        """Shape (samples,), rad."""
        samples = self.normal_n.shape[-1]
        return np.asarray(2.0 * np.pi * self.revolutions / samples * np.arange(samples))

    @property
    def impacts_per_revolution(self) -> float:
        """Times that any key met a face."""
        return np.count_nonzero(self.impacts) / self.revolutions

    @property
    def peak_n(self) -> Array:
        """Greatest force of each key across its slot, shape (4,)."""
        return np.asarray(np.max(np.abs(self.normal_n), axis=-1))

    @property
    def on_scroll_slots_n(self) -> Array:
        """Force of keys 0 and 1 on the scroll along x and y, shape (2, 2, samples)."""
        return -np.stack([self.normal_n[:2], self.friction_n[:2]], axis=1)

    @property
    def on_housing_slots_n(self) -> Array:
        """Force of keys 2 and 3 on the housing along x and y, shape (2, 2, samples)."""
        return -np.stack([self.friction_n[2:], self.normal_n[2:]], axis=1)


def steady_key_forces(
    keys: OldhamKeys,
    ring_mass_kg: float,
    stroke_m: float,
    speed_rpm: float,
    moment_n_m: Array,
    ring_force_n: Array,
    revolutions: int,
    start: int = 0,
) -> KeyForces:
    """Simulate ring and scroll between the faces of the slots.

    The scroll's centre orbits as the crank pin leads it; its turn about this centre is held by
    the keys alone and is free within their clearance, for once a key has left its face the
    scroll's own inertia decides when it returns. A twin ring is the same call with a mass, keys
    and a moment of its own.

    Parameters
    ----------
    keys : geometry, oil, material, friction, inertias
    ring_mass_kg : mass of the ring
    stroke_m : amplitude of the ring's stroke, the orbit radius
    speed_rpm : constant speed of the shaft
    moment_n_m : turns the scroll about its centre, counter-clockwise as the shaft turns, over
        uniform crank angles from zero, shape (samples,), or one value in (1,)
    ring_force_n : force of a balancer on the ring along x, at the same samples, shape (samples,)
    revolutions : to be returned, after those in which the motion settles; only one of those that
        repeat exactly
    start : number of the start, see `start_rates`

    Raises
    ------
    ParameterError
        Speed, moment, force or number of revolutions cannot be.
    SolverError
        The contacts are too stiff to be resolved, or the integration diverged.
    """
    if not 100.0 <= speed_rpm <= 60000.0:
        raise ParameterError(f"speed_rpm = {speed_rpm:g} rpm: must be from 100 to 60000 rpm")
    if revolutions < 1:
        raise ParameterError(f"revolutions = {revolutions}: must be at least 1")
    coupling = _coupling(keys, ring_mass_kg, stroke_m, speed_rpm, moment_n_m, ring_force_n)
    period = 1.0 / shaft_frequency_hz(speed_rpm)
    samples = 2 ** int(np.ceil(np.log2(SAMPLE_RATE_HZ * period)))
    count, rates = SETTLING_REVOLUTIONS + revolutions, start_rates(start, keys.radius_m)
    turns = _turns(count, samples, period / samples, coupling, rates)
    before, *kept_turns = turns[SETTLING_REVOLUTIONS - 1 :]
    if before is kept_turns[-1]:
        kept_turns = kept_turns[:1]
    # An interval's end is its sample: the one before the first kept is at crank angle zero.
    kept = [
        np.ascontiguousarray(np.concatenate(rows)[samples - 1 : -1].T)
        for rows in zip(before, *kept_turns, strict=True)
    ]
    if not all(np.all(np.isfinite(rows)) for rows in kept):
        raise SolverError(f"Oldham keys at {speed_rpm:g} rpm: the integration diverged")
    return KeyForces(speed_rpm, len(kept_turns), *kept)


def start_rates(start: int, radius_m: float) -> Array:
    """Return the rates of the coordinates at the start, shape (4,), m/s and rad/s.

    Parameters
    ----------
    start : 0 from rest; any other number is the seed of random rates, each of which moves a key
        across its slot at 0.05 m/s at most
    radius_m : distance of the keys from the ring's centre
    """
    if start == 0:
        return np.zeros(COORDINATES)
    share = np.random.default_rng(start).uniform(-1.0, 1.0, COORDINATES)
    return np.asarray(START_SPEED_M_PER_S * share / [1.0, 1.0, radius_m, radius_m])


def _turns(
    count: int, samples: int, interval_s: float, coupling: Coupling, rates: Array
) -> list[tuple[Array, ...]]:
    """Normal force, friction and impacts of each revolution, from keys that touch no face.

    Steps are those of loaded keys until a settled revolution has an impact. Once a revolution
    repeats the one before, so do all that follow.
    """
    loaded, fine = (
        _steps(interval_s, ratio * contact_time_s(coupling))
        for ratio in (LOADED_STEP_RATIO, STEP_RATIO)
    )
    motion, deflections = np.zeros((3, COORDINATES)), np.zeros((2, KEYS))
    motion[SPEED] = rates
    turns: list[tuple[Array, ...]] = []
    steps = loaded
    while len(turns) < count:
        first = len(turns) * samples
        turns.append(integrate(motion, deflections, first, samples, interval_s, steps, coupling))
        if len(turns) > 1 and _repeats(*turns[-2:]):
            turns += [turns[-1]] * (count - len(turns))
        if len(turns) >= SETTLING_REVOLUTIONS and turns[-1][-1].any():
            steps = fine
    return turns


def _repeats(before: tuple[Array, ...], after: tuple[Array, ...]) -> bool:
    """Whether forces and impacts of a revolution are those of the one before."""
    return all(
        np.abs(new - old).max() <= REPEATED * np.abs(new).max()
        for old, new in zip(before, after, strict=True)
    )


def _coupling(
    keys: OldhamKeys,
    ring_mass_kg: float,
    stroke_m: float,
    speed_rpm: float,
    moment_n_m: Array,
    ring_force_n: Array,
) -> Coupling:
    return Coupling(
        angular_speed=2.0 * np.pi * shaft_frequency_hz(speed_rpm),
        stroke=stroke_m,
        mass=ring_mass_kg,
        ring_inertia=keys.ring_inertia_kg_m2,
        scroll_inertia=keys.scroll_inertia_kg_m2,
        radius=keys.radius_m,
        clearance=keys.clearance_m,
        face=key_face(keys, ring_mass_kg),
        friction=keys.friction_ratio,
        sticking_speed=STICKING_SPEED_M_PER_S,
        moment=_periodic_spline("moment_n_m", moment_n_m),
        ring_force=_periodic_spline("ring_force_n", ring_force_n),
    )


def _steps(interval_s: float, greatest_s: float) -> int:
    steps = interval_s / greatest_s
    if not steps <= MOST_STEPS:
        raise SolverError(
            f"Oldham keys: contacts too stiff for steps of {interval_s / MOST_STEPS:.2g} s; "
            "lower the moment or crown_radius"
        )
    return int(np.ceil(steps))


def contact_time_s(c: Coupling) -> float:
    """Inverse of the highest angular frequency of contact to be expected, s.

    The deflection is that of the static load and of an impact after a flight over both gaps at the
    orbit's acceleration: ½ m v² = ⅖ K δ^2.5. m is the mass that a key feels of ring and scroll.
    """
    acceleration, stiffness = c.stroke * c.angular_speed**2, c.face.stiffness
    mass = contact_mass_kg(c.mass, c.radius, c.ring_inertia, c.scroll_inertia)
    load = _greatest(c.moment) / c.radius + c.mass * acceleration + _greatest(c.ring_force)
    impact = (1.25 * mass * 4.0 * acceleration * c.clearance / stiffness) ** 0.4
    depth = (0.5 * load / stiffness) ** (2.0 / 3.0) + impact
    return float(np.sqrt(mass / (1.5 * stiffness * np.sqrt(depth))))


def _greatest(spline: Array) -> float:
    return float(np.max(np.abs(spline[3])))


def _periodic_spline(name: str, values: Array) -> Array:
    """Coefficients of the periodic cubic spline through values over one turn, (4, pieces)."""
    if values.ndim != 1 or values.size < 1 or not np.all(np.isfinite(values)):
        raise ParameterError(f"{name}: must be finite values over crank angle, one or more")
    if values.size == 1:
        return np.array([[0.0], [0.0], [0.0], [float(values[0])]])
    closed = np.append(values, values[0])
    angles = np.linspace(0.0, 2.0 * np.pi, closed.size)
    return np.ascontiguousarray(CubicSpline(angles, closed, bc_type="periodic").c)


def contact_loss_speed_rpm(
    keys: OldhamKeys, ring_mass_kg: float, stroke_m: float, moment_n_m: Array
) -> float:
    """Speed above which a key leaves its face: ω² = min (1 - µ) M_z/(m r R |cos θ|), rpm.

    Friction of the housing's keys, µ M_z/R, adds to the push on the ring just after its reversal.
    Left out: the orbit's change of lever arms, r²/(4 R²) of the speed, and the overshoot when
    friction changes its sign: keys part at a speed lower by 4 % with µ = 0.1, by 7 % with 0.15.

    Parameters
    ----------
    keys : their radius and friction
    ring_mass_kg : mass that moves with the ring along its stroke; a pendulum or a sprung mass may
        multiply it
    stroke_m : r, amplitude
    moment_n_m : M_z over uniform crank angles from zero, shape (samples,), or one value in (1,)

    Returns
    -------
    0 if the moment turns its sign
    """
    if np.min(moment_n_m) <= 0.0:
        return 0.0
    if moment_n_m.size == 1:
        share = 1.0 / moment_n_m
    else:
        share = np.abs(np.cos(uniform_crank_angle(moment_n_m.size))) / moment_n_m
    least_ratio = (1.0 - keys.friction_ratio) / float(np.max(share))
    speed = np.sqrt(least_ratio / (ring_mass_kg * stroke_m * keys.radius_m))
    return float(speed) * 30.0 / np.pi


def oldham_key_curves(forces: KeyForces) -> Iterator[Curve]:
    """Force on each of the four keys across its slot and, from friction, along it.

    Parameters
    ----------
    forces : forces of one revolution or more, of which the first is shown
    """
    samples = forces.normal_n.shape[-1] // forces.revolutions
    angle = angle_axis(forces.crank_angle[:samples])
    axes = (CurveAxis("key", list(KEY_NAMES)), angle)
    yield Curve(
        "key_force", "Forces on the Oldham keys across their slots",
        np.asarray(forces.normal_n[:, :samples]), axes, "n", SOURCE,
    )  # fmt: skip
    yield Curve(
        "key_friction_force", "Friction forces on the Oldham keys along their slots",
        np.asarray(forces.friction_n[:, :samples]), axes, "n", SOURCE,
    )  # fmt: skip
