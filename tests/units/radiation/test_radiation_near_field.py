"""The machine side: bodies whose sound field is known."""

import sys

import numpy as np
import pytest
from radiation_parts import floor, join, normal_velocity
from sphere_sound import sphere_pressure
from support import PEAK_MEMORY, in_child, radiated

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.base.revolution import capped_cylinder
from vibroacoustics.radiation import near_run
from vibroacoustics.radiation.bodies import Body, join_bodies, sphere, turned
from vibroacoustics.radiation.box import BoxField
from vibroacoustics.radiation.exact import Mirror, box_green
from vibroacoustics.radiation.machine_side import MachineSide, near_fields
from vibroacoustics.radiation.near_field import NearField
from vibroacoustics.radiation.near_memory import check_memory, memory_bytes
from vibroacoustics.radiation.near_step import RunningTransform, transform_bytes
from vibroacoustics.radiation.patterns import (
    Pattern,
    rigid_body,
    rigid_body_velocity,
)
from vibroacoustics.radiation.scene import Scene
from vibroacoustics.radiation.task import Microphones

RADIUS = 0.12
ANGLES = np.linspace(0.0, np.pi, 11)
FREQUENCY_HZ = np.array([25.0, 48.0, 117.0, 250.0, 500.0, 1000.0, 2000.0, 3000.0, 4000.0])
LOW_HZ = FREQUENCY_HZ[:5]


def pressure(near, field, microphone, walls=(), frequency_hz=LOW_HZ):
    return join(near.box, field, box_green(near.box, np.array(microphone), frequency_hz, walls))


def level_difference(a, b):
    return 20.0 * np.log10(np.abs(a) / np.abs(b))


def legendre(order, radius=RADIUS):
    """Normal velocity P_n(cos theta) about the z axis."""
    series = np.polynomial.Legendre.basis(order)
    return normal_velocity(f"P{order}", lambda points: series(points[:, 2] / radius))


class TestPatterns:
    def test_rotations_turn_right_handed(self):
        point = np.array([0.0, 0.5, 0.0])
        np.testing.assert_allclose(rigid_body_velocity("rx", point), [0.0, 0.0, 0.5])
        np.testing.assert_allclose(rigid_body_velocity("rz", point), [-0.5, 0.0, 0.0])
        np.testing.assert_allclose(rigid_body_velocity("ty", point), [0.0, 1.0, 0.0])

    def test_unknown_dof_is_refused(self):
        with pytest.raises(ParameterError, match="'tw' is not one of tx, ty"):
            rigid_body_velocity("tw", np.zeros(3))


def of_patterns(orders, spacing_m, frequency_hz):
    """Pressure of P_n 1 m off, (order, angle, frequency)."""
    alone = Scene(sphere(RADIUS), (), ())
    points = np.stack([np.sin(ANGLES), 0.0 * ANGLES, np.cos(ANGLES)], axis=1)
    near = near_fields(alone, spacing_m, frequency_hz[-1])
    patterns = [legendre(order) for order in orders]
    side = MachineSide(alone, near, patterns, frequency_hz, [Microphones(points)])
    return side.closed[0].pressure.transpose(1, 0, 2)


@pytest.fixture(scope="module")
def simulated():
    """P_0 to P_3 with the default settings."""
    return of_patterns(range(4), 0.006, FREQUENCY_HZ)


@pytest.mark.long
def test_monopole_and_quadrupole_on_coarse_cells():
    """The short form of the default settings: cells of 12 mm, 0.1 dB and 0.012 rad to 1 kHz."""
    frequency = FREQUENCY_HZ[:6]
    theory = [sphere_pressure(order, RADIUS, 1.0, np.cos(ANGLES), frequency).T for order in (0, 2)]
    exact = np.array(theory)
    ratio = of_patterns((0, 2), 0.012, frequency) / exact
    loud = np.abs(exact) > 0.1 * np.abs(exact).max(axis=1, keepdims=True)
    assert np.abs(20.0 * np.log10(np.abs(ratio[loud]))).max() < 0.1
    assert np.abs(np.angle(ratio[loud])).max() < 0.012


class TestDefaultSettings:
    """Sphere of 0.12 m whose normal velocity is P_n, 6 and 9 mm, 1 m off, against theory."""

    @pytest.mark.long
    @pytest.mark.parametrize("order", range(4))
    def test_every_angle(self, simulated, order):
        """0.1 dB to 1 kHz, 0.3 dB to 4 kHz, at angles less than 20 dB below the loudest."""
        exact = sphere_pressure(order, RADIUS, 1.0, np.cos(ANGLES), FREQUENCY_HZ).T
        loudest = np.abs(exact).max(axis=0)
        difference = np.abs(level_difference(simulated[order], exact))
        difference[np.abs(exact) < 0.1 * loudest] = 0.0
        allowed = np.where(FREQUENCY_HZ <= 1000.0, 0.1, 0.3)
        assert np.all(difference.max(axis=0) <= allowed), difference.max(axis=0).round(3)

    @pytest.mark.long
    @pytest.mark.parametrize("order", range(3))
    def test_phase(self, simulated, order):
        """0.1 dB is 1.2 % of the pressure; as a phase 0.012 rad, to 1 kHz."""
        exact = sphere_pressure(order, RADIUS, 1.0, np.cos(ANGLES), FREQUENCY_HZ).T[:, :5]
        loud = np.abs(exact) > 0.1 * np.abs(exact).max(axis=0)
        phase = np.angle(simulated[order, :, :5] / exact)
        assert np.abs(phase[loud]).max() < 0.012


@pytest.mark.long
def test_error_falls_with_the_square_of_the_spacing():
    """Oscillating sphere, 1 m on the axis: complex error against the exact field.

    The observed order of two neighbouring spacings; the cut differs from one to the next.
    """
    frequency = np.array([500.0, 1000.0, 1500.0])
    exact = sphere_pressure(1, RADIUS, 1.0, np.ones(1), frequency)[:, 0]
    spacings = np.array([0.024, 0.016, 0.012])
    errors = []
    for spacing in spacings:
        near = NearField(sphere(RADIUS), spacing, 1500.0)
        field = radiated(near, rigid_body("tz"), frequency)
        simulated = pressure(near, field, [0.0, 0.0, 1.0], frequency_hz=frequency)
        errors.append(np.abs(simulated / exact - 1))
    order = np.log(errors[0] / errors[2]) / np.log(spacings[0] / spacings[2])
    assert np.all((order > 1.6) & (order < 2.6)), order


def test_sphere_off_the_origin_radiates_the_same():
    centre = np.array([0.0041, -0.0037, 0.0029])
    near = NearField(sphere(RADIUS, tuple(centre)), 0.0125, 2500.0)
    field = radiated(near, rigid_body("tz"), LOW_HZ)
    expected = sphere_pressure(1, RADIUS, 1.0, np.array([0.8]), LOW_HZ)[:, 0]
    simulated = pressure(near, field, centre + np.array([0.6, 0.0, 0.8]))
    # One grid of 12.5 mm, no extrapolation.
    np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.1)


@pytest.mark.slow
def test_pressure_does_not_depend_on_the_box():
    """Margins of three and of six cells: the absorbing layer moves along, and errs anew."""
    body, wall = turned(capped_cylinder(0.0825, -0.2, 0.217)), floor(-0.26)
    rigid = Pattern("t", lambda at: np.array([1.0, 0.0, 1.0]) + 0.0 * at.position)
    results = []
    for margin in (0.06, 0.12):
        near = NearField(body, 0.02, 1500.0, (wall,), box_margin_m=margin)
        field = radiated(near, rigid, LOW_HZ)
        results.append(
            [pressure(near, field, at, (wall,)) for at in ([0.16, -0.96, 0.0], [0.0, 0.0, 1.0])]
        )
    np.testing.assert_allclose(level_difference(*results), 0.0, atol=0.15)


def test_sliding_wall_radiates_nothing_without_a_run():
    near = NearField(turned(capped_cylinder(0.0825, -0.2, 0.217)), 0.0165, 1500.0)
    calls = []
    field = radiated(near, rigid_body("rz"), LOW_HZ, lambda *call: calls.append(call))
    assert not calls
    assert not field.inner.any()
    assert not field.outer.any()


@pytest.mark.slow
@pytest.mark.parametrize("axis", [pytest.param(0, marks=pytest.mark.long), 2])
def test_wall_equals_free_field_with_the_mirrored_body(axis):
    """A sphere before a hard wall, and two spheres in free field that move as mirror images.

    Both grids have the same cells before the wall; lines through the body are off their places by
    1e-6 of a cell. The dipole of the cells' offsets across the
    wall is taken off on the one side and cancels on the other: a ten-thousandth of the fluxes.
    """
    radius, place = 0.09, -0.11
    flip = np.where(np.arange(3) == axis, -1.0, 1.0)
    wall = Mirror(axis, -1, place)
    body = sphere(radius)
    shift = np.where(np.arange(3) == axis, 2.0 * place, 0.0)
    image = Body(body.vertices * flip + shift, body.faces[:, ::-1])

    def velocity(points):
        """Every direction and rotation, and breathing, at once."""
        turning = np.cross([3.0, -7.0, 5.0], points)
        return np.array([1.0, 0.5, 0.7]) + turning + 4.0 * points

    def mirrored(at):
        before = (at.position[:, axis] > place)[:, None]
        return np.where(before, velocity(at.position), flip * velocity(flip * at.position + shift))

    near = NearField(body, 0.015, 1500.0, (wall,))
    alone = radiated(near, Pattern("all", lambda at: velocity(at.position)), LOW_HZ)
    free = NearField(join_bodies([body, image]), 0.015, 1500.0)
    both = radiated(free, Pattern("all", mirrored), LOW_HZ)
    microphone = np.array([0.5, 0.3, 0.7])
    simulated = pressure(near, alone, microphone, (wall,))
    expected = pressure(free, both, microphone)
    assert np.all(np.abs(simulated - expected) < 1e-4 * np.abs(expected))


@pytest.mark.slow
def test_far_from_the_floor_the_image_alone_is_right():
    """Five radii up, a pulsating sphere and its image hardly scatter each other's sound."""
    radius, wall = 0.06, floor(-0.3)
    near = NearField(sphere(radius), 0.012, 1500.0, (wall,))
    field = radiated(near, legendre(0, radius), LOW_HZ[:3])
    simulated = pressure(near, field, [0.9, 0.0, 0.2], (wall,), LOW_HZ[:3])
    expected = sum(
        sphere_pressure(0, radius, np.hypot(0.9, z), np.ones(1), LOW_HZ[:3])[:, 0]
        for z in (0.2, 0.8)
    )
    # The image's velocity at the sphere is (a/2h)^2 = 1 % of the wall's and makes only a dipole.
    np.testing.assert_allclose(level_difference(simulated, expected), 0.0, atol=0.1)


def test_translation_of_a_body_on_the_floor_displaces_air():
    """The bottom is not in the air: the top's volume velocity remains: a monopole."""
    wall = floor(-0.2)
    near = NearField(turned(capped_cylinder(0.0825, -0.2, 0.0)), 0.0165, 1500.0, (wall,))
    low = np.array([20.0])
    field = radiated(near, rigid_body("tz"), low)
    simulated = pressure(near, field, [3.0, 0.0, -0.2], (wall,), low)
    # j omega rho Q G with Q = pi R² and the source's own image: low frequency, far off.
    monopole = 2 * np.pi * 20 * 1.2 * np.pi * 0.0825**2 * 2 / (4 * np.pi * 3.0)
    np.testing.assert_allclose(np.abs(simulated), monopole, rtol=0.03)


def test_reciprocal_green_functions_leave_no_pressure_of_their_own():
    """Two outside sources satisfy the join's integral with zero: nothing radiates from inside."""
    near = NearField(sphere(0.1), 0.0125, 1000.0)
    first, second = (
        box_green(near.box, np.array(p), LOW_HZ) for p in ([1.0, 0.2, 0.1], [-0.3, 0.9, 0.4])
    )
    residue = np.abs(join(near.box, first, second))
    scale = np.abs(join(near.box, BoxField(first.inner, 0 * first.outer), second))
    assert np.all(residue < 5e-3 * scale)


def test_memory_is_checked_before_the_run(monkeypatch):
    monkeypatch.setattr("psutil.virtual_memory", type("M", (), {"available": 2**20}))
    near = near_fields(Scene(sphere(0.1), (), ()), 0.0125, 1000.0)
    with pytest.raises(ParameterError, match=r"near_field_spacing_mm: the grid of \d+×\d+×\d+"):
        check_memory(near, 6, 10)


def test_a_running_transform_is_the_sum_over_all_samples():
    """Of 200 samples, more than three blocks of 64; asked for between, it goes on."""
    time_s, hertz = 1e-4 * np.arange(200), np.array([25.0, 130.0, 900.0])
    signals = np.random.default_rng(3).standard_normal((200, 5))
    running = RunningTransform(hertz, 5)
    for number, (at_s, samples) in enumerate(zip(time_s, signals, strict=True)):
        running.next_row(at_s)[...] = samples
        if number == 100:
            running.spectrum()
    expected = np.exp(-2j * np.pi * hertz[:, None] * time_s) @ signals
    np.testing.assert_allclose(running.spectrum(), expected, atol=1e-11)


def test_memory_of_a_running_transform():
    """Real and imaginary sums of 240 frequencies, twice, and 64 samples, 8 B each."""
    assert transform_bytes(240, 1000) == 8 * 1000 * (2 * 2 * 240 + 64)


def test_green_functions_of_the_room_count():
    """16 B for each of 240 frequencies, 40 microphones and points of both layers of the box."""
    near = near_fields(Scene(sphere(0.1), (), ()), 0.0125, 1000.0)
    more = memory_bytes(near, 6, 240, 40) - memory_bytes(near, 6, 240)
    kept = 16 * 240 * 40 * 2 * near[0].box.weights.size
    assert kept < more < 1.2 * kept


@pytest.mark.long
@pytest.mark.skipif(sys.platform != "linux", reason="reads the peak memory as Linux tells it")
@pytest.mark.parametrize(
    ("spacing_m", "frequencies", "patterns"),
    [(0.006, 80, 6), (0.005, 20, 2)],
)
def test_predicted_memory_is_what_it_takes(spacing_m, frequencies, patterns):
    """The default settings first, against the peak beyond a small run's; on one processor.

    A bound: a rigid motion has one or two of the four parts that any pattern may have.
    """
    measured, predicted = in_child(f"""
        {PEAK_MEMORY}
        import os
        os.sched_setaffinity(0, {{min(os.sched_getaffinity(0))}})
        import numpy as np
        from vibroacoustics.radiation import near_run
        from vibroacoustics.base.revolution import capped_cylinder
        from vibroacoustics.radiation.bodies import turned
        from vibroacoustics.radiation.machine_side import MachineSide, near_fields
        from vibroacoustics.radiation.near_memory import memory_bytes
        from vibroacoustics.radiation.exact import Mirror
        from vibroacoustics.radiation.patterns import rigid_body
        from vibroacoustics.radiation.scene import Scene
        from vibroacoustics.radiation.task import Microphones
        from vibroacoustics.base.vocabulary import RIGID_BODY_DOFS
        # Short runs that would not be accepted: their length takes no memory.
        near_run._MOST_PASSAGES, near_run._NOT_QUIET = 2, 1.0
        scene = Scene(turned(capped_cylinder(0.0825, -0.19, 0.227)), (), (Mirror(2, -1, -0.21),))
        motions = [rigid_body(dof) for dof in RIGID_BODY_DOFS[:{patterns}]]
        frequency = np.linspace(25.0, 2000.0, {frequencies})
        microphones = [Microphones(np.array([[1.0, 0.2, 0.1], [-0.5, 0.8, 0.6]]))]
        small = near_fields(scene, 0.024, 4000.0)
        MachineSide(scene, small, motions, frequency[:2], microphones)
        before = peak()
        near = near_fields(scene, {spacing_m}, 4000.0)
        MachineSide(scene, near, motions, frequency, microphones)
        print(peak(forget=False) - before, memory_bytes(near, {patterns}, {frequencies}))
    """)
    assert 0.9 * float(measured) < float(predicted) < 4.0 * float(measured)


def test_a_run_that_has_not_died_down_is_refused(monkeypatch):
    monkeypatch.setattr(near_run, "_MOST_PASSAGES", 0)
    with pytest.raises(SolverError, match="near field tx: the pressure has not died down"):
        radiated(NearField(sphere(0.1), 0.02, 1000.0), rigid_body("tx"), LOW_HZ)


def test_a_velocity_that_is_no_number_is_refused():
    pattern = normal_velocity("bad", lambda points: np.where(points[:, 2] > 0.09, np.nan, 1.0))
    with pytest.raises(SolverError, match="near field bad: the pressure is no number"):
        radiated(NearField(sphere(0.1), 0.02, 1000.0), pattern, LOW_HZ)


def test_all_runs_of_one_body_are_repeatable():
    near = NearField(sphere(0.06), 0.0165, 1000.0)
    first, second = (radiated(near, rigid_body("tx"), LOW_HZ) for _ in range(2))
    np.testing.assert_array_equal(first.inner, second.inner)
