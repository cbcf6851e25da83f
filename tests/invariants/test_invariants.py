"""Laws that the numbers must obey whatever the parameters are."""

import numpy as np
import pytest
from documents import FORM
from evidence import claim
from hypothesis import given, settings
from hypothesis import strategies as st
from radiation_parts import floor, join, normal_velocity
from sphere_sound import sphere_pressure
from support import (
    CRANK_ANGLE,
    ROUNDING,
    balancing,
    machine_parts,
    radiated,
    turning,
    wrench_orders,
    wrench_rounding,
)

from vibroacoustics.base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from vibroacoustics.levels import energy_difference, energy_sum
from vibroacoustics.machine.feet import Mounts
from vibroacoustics.machine.housing import Housing
from vibroacoustics.mechanics.moving_parts import MovingPart, path, wrench
from vibroacoustics.mechanisms.oldham_scroll.revolution import (
    circling,
    counterweight,
    rotating_set,
    two_plane_balance,
)
from vibroacoustics.orders import order_spectrum, semi_major_axis
from vibroacoustics.radiation.bodies import sphere
from vibroacoustics.radiation.cabinet import cabinet_panels
from vibroacoustics.radiation.exact import box_green
from vibroacoustics.radiation.machine_side import EXTRAPOLATION
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.near_step import Fields
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.study.surroundings import Cabinet
from vibroacoustics.transfer import MachineOnMounts

OPTIONS = (
    "none", "pendulum-side", "pendulum-inline", "spring-mass", "spring-mass-printed",
    "twin-oldham", "damping", "counterweight-half",
)  # fmt: skip
EPSILON = np.finfo(float).eps

masses = st.floats(1e-3, 10.0)
heights = st.floats(-0.3, 0.3)
vectors = st.lists(st.complex_numbers(max_magnitude=1e3), min_size=3, max_size=3).map(np.array)


# --- moving parts --------------------------------------------------------------------------------


def test_balanced_rotating_set_shakes_nothing(thesis_study):
    parts = rotating_set(thesis_study.machine, CRANK_ANGLE)
    force, moment = wrench(parts, turning(58.0))
    force_error, moment_error = wrench_rounding(parts, 58.0)
    assert np.max(np.abs(force)) < force_error
    assert np.max(np.abs(moment)) < moment_error
    alone = [np.max(np.abs(wrench([part], turning(58.0))[0])) for part in parts]
    assert force_error < 1e-9 * max(alone)  # the bound itself says zero


@settings(max_examples=50, deadline=None)
@given(
    rotors=st.lists(st.tuples(masses, st.floats(1e-3, 0.05), heights), min_size=1, max_size=5),
    lower=st.floats(-0.2, -0.01),
    upper=st.floats(0.01, 0.2),
)
def test_two_plane_balance_cancels_force_and_couple(rotors, lower, upper):
    moments = [mass * radius for mass, radius, _ in rotors]
    planes = two_plane_balance(moments, [z for _, _, z in rotors], upper, lower)
    weights = [
        counterweight("upper", planes[0], 0.025, upper, CRANK_ANGLE),
        counterweight("lower", planes[1], 0.025, lower, CRANK_ANGLE),
    ]
    parts = [circling("rotor", *rotor, CRANK_ANGLE) for rotor in rotors] + weights
    force, moment = wrench(parts, turning(50.0))
    force_error, moment_error = wrench_rounding(parts, 50.0)
    assert np.max(np.abs(force)) < force_error
    assert np.max(np.abs(moment)) < moment_error


def test_twin_ring_couple_is_force_times_distance(thesis_study):
    for speed in (2900.0, 3500.0):
        force, moment = wrench_orders(thesis_study, "twin-oldham", speed)
        ring, _ = wrench_orders(thesis_study, "none", speed)
        distance = thesis_study.options["twin-oldham"].distance_below_ring_m
        alone = semi_major_axis(ring, axis=0)[1]
        assert np.max(np.abs(force)) < 2.0 * ROUNDING * alone  # of two parts
        assert semi_major_axis(moment, axis=0)[1] == pytest.approx(distance * alone, rel=ROUNDING)


@settings(max_examples=30, deadline=None)
@given(height=heights, shift=st.tuples(heights, heights, heights))
def test_couple_does_not_depend_on_the_origin(height, shift):
    """A pair of opposite forces has the same moment about every point."""
    swing = 0.01 * np.cos(CRANK_ANGLE)

    def pair(offset):
        dx, dy, dz = offset
        return [
            MovingPart("a", 1.0, path(dx + swing, dy, dz + height)),
            MovingPart("b", 1.0, path(dx - swing, dy, dz - height)),
        ]

    here, there = pair((0.0, 0.0, 0.0)), pair(shift)
    error = wrench_rounding(here, 50.0)[1] + wrench_rounding(there, 50.0)[1]
    difference = wrench(there, turning(50.0))[1] - wrench(here, turning(50.0))[1]
    assert np.max(np.abs(difference)) < error


@settings(max_examples=30, deadline=None)
@given(direction=st.tuples(*[st.floats(-1.0, 1.0)] * 3), mass=masses)
def test_line_through_the_centre_of_mass_makes_no_moment(direction, mass):
    swing = 0.02 * np.cos(CRANK_ANGLE) + 0.003 * np.sin(3.0 * CRANK_ANGLE) + 0.01
    part = MovingPart("slider", mass, np.outer(direction, swing))
    _, moment = wrench([part], turning(50.0))
    assert np.max(np.abs(moment)) <= wrench_rounding([part], 50.0)[1]


def test_part_at_rest_makes_no_force():
    force, moment = wrench(
        [MovingPart("still", 5.0, path(0.1 + 0 * CRANK_ANGLE, 0.2, 0.3))], turning(50.0)
    )
    assert not force.any()
    assert not moment.any()


@pytest.mark.parametrize("ratio", [0.5, 2.0, 3.7])
def test_forces_scale_with_the_square_of_speed(thesis_study, ratio):
    parts = machine_parts(thesis_study)
    force, moment = wrench(parts, turning(50.0))
    faster = wrench(parts, turning(50.0 * ratio))
    # Only the factor ω² differs, before the sum over the parts: eps of the largest, 900 N.
    slack = 10.0 * EPSILON * ratio**2 * 900.0
    np.testing.assert_allclose(faster[0], ratio**2 * force, rtol=0.0, atol=slack)
    np.testing.assert_allclose(faster[1], ratio**2 * moment, rtol=0.0, atol=slack)


@pytest.mark.parametrize("speed", [2900.0, 3500.0])
@pytest.mark.parametrize("option", OPTIONS)
def test_sum_over_parts_is_the_total(thesis_study, option, speed):
    parts = [*machine_parts(thesis_study), *balancing(thesis_study, option, speed).parts]
    total = wrench(parts, turning(speed / 60.0))
    single = [wrench([part], turning(speed / 60.0)) for part in parts]
    for whole, pieces in zip(total, zip(*single, strict=True), strict=True):
        size = np.sum(np.max(np.abs(pieces), axis=(1, 2)))
        np.testing.assert_allclose(
            whole, np.sum(pieces, axis=0), rtol=0.0, atol=len(parts) * EPSILON * size
        )


@pytest.mark.parametrize("option", OPTIONS)
def test_inertia_forces_have_no_mean(thesis_study, option):
    """Momentum is periodic, so its rate of change averages to zero."""
    force, _ = wrench_orders(thesis_study, option, 3500.0)
    assert np.max(np.abs(force[:, 0])) < ROUNDING * 300.0  # largest force of any option, N


@pytest.mark.parametrize("speed", [2900.0, 3500.0])
def test_damping_changes_no_force(thesis_study, speed):
    """An internal pair on a prescribed motion: 0 dB."""
    assert balancing(thesis_study, "damping", speed).parts == ()
    damped = wrench_orders(thesis_study, "damping", speed)
    bare = wrench_orders(thesis_study, "none", speed)
    np.testing.assert_array_equal(damped, bare)


@pytest.mark.parametrize("speed", [2900.0, 3500.0])
def test_half_counterweight_leaves_a_backward_circle(thesis_study, speed):
    """F cos ωt less a forward F/2 is a backward F/2: F_y lags by -90°, both of half size."""
    half, _ = wrench_orders(thesis_study, "counterweight-half", speed)
    bare, _ = wrench_orders(thesis_study, "none", speed)
    alone = abs(bare[0, 1])
    assert half[0, 1] == pytest.approx(bare[0, 1] / 2.0, abs=ROUNDING * alone)
    assert half[1, 1] == pytest.approx(1j * bare[0, 1] / 2.0, abs=ROUNDING * alone)


def test_more_share_than_half_brings_the_force_back(thesis_study):
    """Semi-major axis max(1 - s, s): 0.5 is the best share."""
    option = thesis_study.options["counterweight-half"]
    for share in (0.0, 0.25, 0.5, 0.75, 1.0):
        changed = option.model_copy(update={"share_ratio": share})
        study = thesis_study.model_copy(update={"options": {"it": changed}})
        force, _ = wrench_orders(study, "it", 3500.0)
        assert semi_major_axis(force, axis=0)[1] == pytest.approx(
            max(1.0 - share, share) * 65.922, rel=1e-5
        )  # 65.922 has five digits


# --- orders --------------------------------------------------------------------------------------


@settings(max_examples=30, deadline=None)
@given(seed=st.integers(0, 2**32 - 1), samples=st.sampled_from([65, 129, 255]))
def test_parseval(seed, samples):
    """Mean square of the signal = X0² + Σ |X_k|²/2; an odd number of samples has all orders."""
    signal = np.random.default_rng(seed).standard_normal(samples)
    spectrum = order_spectrum(signal, (samples - 1) // 2)
    power = abs(spectrum[0]) ** 2 + np.sum(np.abs(spectrum[1:]) ** 2) / 2.0
    assert power == pytest.approx(np.mean(signal**2), rel=100.0 * EPSILON)


@settings(max_examples=50, deadline=None)
@given(phasor=vectors)
def test_semi_major_axis_is_the_largest_radius_of_the_ellipse(phasor):
    turn = np.exp(2j * np.pi * np.arange(720) / 720)
    radius = np.linalg.norm(np.real(phasor[:, None] * turn), axis=0)
    axis = semi_major_axis(phasor, axis=0)
    # Sampling misses the top by at most 0.25°, that is by 1 - cos 0.25° = 1e-5; rounding under
    # the root of cancelling squares: eps of the sum of squares.
    slack = 4.0 * EPSILON * np.linalg.norm(phasor)
    assert np.max(radius) <= axis + slack
    assert axis * (1.0 - 1e-5) <= np.max(radius) + slack


@settings(max_examples=50, deadline=None)
@given(phasor=vectors, rotation=st.tuples(*[st.floats(-1.0, 1.0)] * 4), phase=st.floats(0.0, 6.3))
def test_semi_major_axis_does_not_depend_on_the_frame(phasor, rotation, phase):
    a, b, c, d = np.array(rotation) / max(np.linalg.norm(rotation), 1e-9)
    if np.linalg.norm(rotation) < 1e-6:
        a, b, c, d = 1.0, 0.0, 0.0, 0.0
    turn = np.array(
        [
            [1 - 2 * (c * c + d * d), 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), 1 - 2 * (b * b + d * d), 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), 1 - 2 * (b * b + c * c)],
        ]
    )
    turned = semi_major_axis(turn @ phasor * np.exp(1j * phase), axis=0)
    # The root of a sum of squares: eps of the norm, amplified by no more than √2; ten operations.
    assert turned == pytest.approx(
        semi_major_axis(phasor, axis=0), abs=20.0 * EPSILON * np.linalg.norm(phasor)
    )


def test_semi_major_axis_of_line_and_circle():
    assert semi_major_axis(np.array([3.0, 4.0, 0.0]) * 1j, axis=0) == pytest.approx(5.0)
    assert semi_major_axis(np.array([2.0, -2.0j, 0.0]), axis=0) == pytest.approx(2.0)


# --- machine on its mounts -----------------------------------------------------------------------


@st.composite
def bodies(draw):
    a, b = draw(st.floats(0.1, 2.0)), draw(st.floats(0.1, 2.0))
    c = draw(st.floats(abs(a - b) + 0.01, a + b - 0.01))
    housing = Housing(
        mass_kg=draw(st.floats(5.0, 100.0)),
        inertia_xx_kg_m2=a,
        inertia_yy_kg_m2=b,
        inertia_zz_kg_m2=c,
    )
    mounts = Mounts(
        pitch_m=draw(st.floats(0.1, 0.5)),
        lateral_stiffness_n_per_m=draw(st.floats(5e3, 5e4)),
        vertical_stiffness_n_per_m=draw(st.floats(5e3, 1e5)),
        loss_factor_ratio=draw(st.floats(0.02, 0.3)),
    )
    return MachineOnMounts(housing, mounts, draw(st.floats(-0.4, 0.1)))


loads = st.lists(st.complex_numbers(max_magnitude=100.0), min_size=6, max_size=6).map(np.array)
frequencies = st.floats(0.5, 2000.0)


@settings(max_examples=40, deadline=None)
@given(body=bodies(), frequency=frequencies)
def test_reciprocity(body, frequency):
    receptance = body.isolation.receptance(frequency)
    # Inverse of a symmetric matrix: rounding times its condition, which scaling by units causes.
    condition = np.linalg.cond(receptance)
    scale = np.max(np.abs(receptance))
    assert np.max(np.abs(receptance - receptance.T)) <= 10.0 * EPSILON * condition * scale


@settings(max_examples=40, deadline=None)
@given(body=bodies(), load=loads)
def test_velocity_at_high_frequency_is_that_of_the_free_body(body, load):
    frequency = 2e4
    velocity = body.response(load, frequency).velocity
    omega = 2.0 * np.pi * frequency
    free = np.linalg.solve(body.isolation.mass_matrix, load) / (1j * omega)
    # (K' - ω²M)⁻¹ = -(ω²M)⁻¹ [1 + E + E² …] with E = K'M⁻¹/ω², |E| about 1e-5.
    error = np.linalg.norm(
        np.linalg.solve(body.isolation.mass_matrix, body.isolation.stiffness_matrix), 2
    ) * 1.05 / omega**2  # fmt: skip
    assert error < 1e-3
    limit = 1.01 * error * np.linalg.norm(free) + 1e-300
    assert np.linalg.norm(velocity - free) <= limit


@settings(max_examples=40, deadline=None)
@given(body=bodies(), load=loads)
def test_static_limit(body, load):
    static = np.linalg.solve(body.isolation.stiffness_matrix, load)
    close = body.isolation.receptance(0.0) @ load
    tolerance = (
        10.0 * EPSILON * np.linalg.cond(body.isolation.stiffness_matrix) * np.linalg.norm(static)
    )
    assert np.linalg.norm(close - static) <= tolerance
    assert not body.response(load, 0.0).velocity.any()


@settings(max_examples=40, deadline=None)
@given(body=bodies(), load=loads, frequency=st.just(0.0) | frequencies)
def test_feet_carry_the_load_less_the_inertia(body, load, frequency):
    """Newton and Euler for the body: Σ foot force = F - m a, Σ p x foot force = M - I α."""
    foot_force = body.response(load, frequency).foot_force
    displacement = body.isolation.receptance(frequency) @ load
    omega = 2.0 * np.pi * frequency
    inertia = -(omega**2) * body.isolation.mass_matrix @ displacement
    left = np.concatenate(
        [foot_force.sum(axis=0), np.cross(body.foot_position, foot_force).sum(axis=0)]
    )
    size = np.linalg.norm(load) + np.linalg.norm(inertia)
    condition = np.linalg.cond(body.isolation.receptance(frequency))
    np.testing.assert_allclose(left, load - inertia, atol=20.0 * EPSILON * condition * size)


@settings(max_examples=40, deadline=None)
@given(body=bodies(), load=loads, frequency=frequencies)
def test_mounts_are_passive(body, load, frequency):
    """The power that a force puts in, Re(F* v)/2, is never negative."""
    velocity = body.response(load, frequency).velocity
    power = 0.5 * np.real(np.vdot(load, velocity))
    assert power >= -1e-12 * np.linalg.norm(load) * np.linalg.norm(velocity)


def test_response_broadcasts_over_frequency(thesis_study):
    machine = thesis_study.machine
    body = MachineOnMounts(machine.housing, machine.mounts, -0.19)
    load = np.arange(12.0).reshape(2, 1, 6).astype(complex)
    frequency = np.array([[10.0, 20.0, 30.0]])
    velocity = body.response(load, frequency).velocity
    assert velocity.shape == (2, 3, 6)
    np.testing.assert_allclose(velocity[1, 2], body.response(load[1, 0], 30.0).velocity, rtol=1e-12)


# --- levels --------------------------------------------------------------------------------------


@given(
    part=st.floats(-20.0, 120.0),
    # energy_difference loses digits as the rest sinks below the part: eps · 10^(gap/10).
    gap=st.floats(-60.0, 60.0),
)
def test_energy_difference_undoes_energy_sum(part, gap):
    rest = part + gap
    total = float(energy_sum(np.array([part, rest]), axis=0))
    loss = 1e3 * EPSILON * 10.0 ** (max(-gap, 0.0) / 10.0)
    assert energy_difference(total, part) == pytest.approx(rest, abs=max(loss, 1e-12))


@given(level=st.floats(-100.0, 150.0), count=st.integers(1, 50))
def test_equal_sounds_add_10_lg_n(level, count):
    total = energy_sum(np.full(count, level), axis=0)
    assert total == pytest.approx(level + 10.0 * np.log10(count), abs=1e-10)


def test_no_louder_part_than_the_total():
    with pytest.raises(ValueError, match="not below"):
        energy_difference(56.0, 56.0)


# --- sound ---------------------------------------------------------------------------------------

SOUND_HZ = np.array([100.0, 250.0, 500.0, 800.0])
BREATHING = normal_velocity("breathing", lambda points: np.ones(len(points)))


def power_through(box, field):
    """Sound power out of a box, W, (frequency,).

    1/2 Re(p u*) A with p = (p_i + p_o)/2 and, by Euler, u = j (p_o - p_i)/(omega rho d): the
    squares drop out, and A/(2 omega rho d) Im(p_i p_o*) is left.
    """
    inward = np.imag(field.inner * np.conj(field.outer)) @ box.weights
    return inward / (2.0 * 2.0 * np.pi * SOUND_HZ * AIR_DENSITY_KG_PER_M3)


@pytest.mark.slow
def test_power_through_the_box_is_that_of_the_pulsating_sphere():
    """Within 1 % (0.04 dB): 18 and 12 mm, extrapolated; 1/2 Re(p v*) 4 pi a² in theory."""
    radius, powers = 0.12, []
    for spacing, cells in ((0.012, 3), (0.018, 2)):
        near = NearField(sphere(radius), spacing, 1500.0, cells_per_unit=cells)
        powers.append(power_through(near.box, radiated(near, BREATHING, SOUND_HZ)))
    ours = powers[0] + EXTRAPOLATION * (powers[0] - powers[1])
    on_wall = sphere_pressure(0, radius, radius, np.ones(1), SOUND_HZ)[:, 0]
    exact = 2.0 * np.pi * radius**2 * on_wall.real
    claim(
        "Power of a pulsating sphere through the box", kind="exact", computed=ours, unit="W",
        source=FORM("½ Re(p v*) 4π a²"), reference=exact, tolerance=0.01 * exact,
        topics=("radiation",),
    )  # fmt: skip


FLOOR = floor(-0.1)
SMALL_CABINET = Cabinet(
    depth_m=0.3,
    width_m=0.3,
    height_m=0.25,
    panel_thickness_m=0.02,
    open_sides=("+x", "top"),
)


@pytest.fixture(scope="module")
def cabinet() -> tuple[NearField, Scene]:
    """A sphere over the floor between three panels, each one cell of 20 mm thick."""
    machine = sphere(0.06)
    panels = cabinet_panels(SMALL_CABINET, FLOOR.position_m)
    surroundings = Scene(machine, tuple(panels), (FLOOR,))
    return NearField(surroundings.body, 0.02, 1500.0, (FLOOR,), cells_per_unit=1), surroundings


@pytest.mark.slow
def test_power_through_the_box_arrives_far_off(cabinet):
    """A sphere between three panels: box against the hemisphere at 60 m, within 2 %.

    |p|²/(2 rho c) over the hemisphere; the box's half diagonal is 0.4 m with its image, ka = 6 at
    800 Hz, so |p|² holds harmonics up to about 20: 12 x 24 directions are exact for them.
    """
    near, surroundings = cabinet
    field = radiated(near, surroundings.moving(BREATHING), SOUND_HZ)
    cosines, weights = np.polynomial.legendre.leggauss(12)
    cosines, weights = (cosines + 1.0) / 2.0, weights / 2.0
    azimuths = 2.0 * np.pi * np.arange(24) / 24
    distance = 60.0
    total = np.zeros(SOUND_HZ.size)
    for cosine, weight in zip(cosines, weights, strict=True):
        sine = np.sqrt(1.0 - cosine**2)
        for azimuth in azimuths:
            direction = np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), cosine])
            place = distance * direction + [0.0, 0.0, FLOOR.position_m]
            green = box_green(near.box, place, SOUND_HZ, (FLOOR,))
            total += weight / 24 * np.abs(join(near.box, field, green)) ** 2
    impedance = AIR_DENSITY_KG_PER_M3 * SPEED_OF_SOUND_M_PER_S
    far = 2.0 * np.pi * distance**2 * total / (2.0 * impedance)
    claim(
        "Power out of a small cabinet, box beside far field", kind="exact", unit="W",
        source=FORM("|p|²/(2 ρ c) over a hemisphere of 60 m"),
        computed=power_through(near.box, field), reference=far, tolerance=0.02 * far,
        topics=("cabinet",),
    )  # fmt: skip


@pytest.mark.slow
def test_pressure_in_the_cabinet_is_reciprocal(cabinet):
    """v_i p_i(source in j) = v_j p_j(source in i), v the volumes of air in the two cells.

    A step is p_i -= C² h²/(v_i) sum over faces of (open area/gap)(...): v_i times that couples both
    cells alike, and so do all powers of the operator and, with the layers' factors as a stretch of
    space, the layers. To 1e-12 of the largest: some hundred steps of rounding, 1e-16.
    """
    near, _ = cabinet
    grid, cells = near.grid, near.cells
    volume = cells.volumes * np.einsum("i,j,k->ijk", *(grid.widths(axis) for axis in range(3)))
    fraction = cells.volumes.ravel()
    cut = cells.wall_cells[np.argmin(np.abs(fraction[cells.wall_cells] - 0.3))]
    places = np.array([[0.22, 0.03, 0.05], [-0.05, 0.09, 0.01], [0.02, -0.02, 0.19]])
    chosen = [int(cut), *map(int, grid.cells_at(places))]
    assert 0.1 < fraction[cut] < 0.6
    assert np.all(fraction[chosen[1:]] == 1.0)
    traces = {}
    for source in chosen:
        fields = Fields(grid, cells.open_areas, cells.volumes, ())
        listening = fields.flat_indices(np.array(chosen))
        fields.add(fields.flat_indices(np.array([source])), np.ones(1))
        heard = []
        for _ in range(300):
            fields.advance()
            heard.append(fields.pressure(listening))
        for row, place in enumerate(chosen):
            traces[place, source] = volume.ravel()[place] * np.array(heard, dtype=float)[:, row]
    for number, first in enumerate(chosen):
        for second in chosen[:number]:
            there, back = traces[first, second], traces[second, first]
            np.testing.assert_allclose(there, back, atol=1e-12 * np.abs(there).max(), rtol=0.0)
