"""Rigid bodies on bushings: one body against its equations, two by second methods."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.machine.feet import Mounts
from vibroacoustics.machine.housing import Housing
from vibroacoustics.mechanics.bushings import Bushing, RigidBody
from vibroacoustics.transfer import MachineOnMounts
from vibroacoustics.transfer.isolation import Isolation
from vibroacoustics.transfer.tube import tube_stiffness

STEEL_PA, POISSON = 2.0e11, 0.3
ROUNDING = 1e-10
"""Rounding of a 12 x 12 solve: eps times a condition number of up to 1e5 (N/m against N m)."""


def spring(*stiffness: float) -> np.ndarray:
    return np.diag([*stiffness, 0.0, 0.0, 0.0])


@pytest.fixture(scope="module")
def two_stage() -> Isolation:
    """A block of 6.5 kg on three springs in a shell of 4 kg on three grommets, and a tube."""
    block = RigidBody("block", 6.5, np.diag([0.03, 0.03, 0.02]), np.array([5e-3, 0.0, 0.02]))
    shell_inertia = np.array([[0.05, 2e-3, 0.0], [2e-3, 0.06, -1e-3], [0.0, -1e-3, 0.04]])
    shell = RigidBody("shell", 4.0, shell_inertia, np.array([0.0, 3e-3, 0.0]))
    tube = tube_stiffness(
        np.array([[0.03, 0, 0], [0.03, 0.05, 0], [0.07, 0.05, 0.02], [0.08, 0, 0.02]]),
        5e-3, 3.6e-3, STEEL_PA, POISSON,
    )  # fmt: skip
    angles = np.deg2rad([0.0, 120.0, 240.0])
    springs = [
        Bushing(
            f"spring_{number}", "block", "shell",
            np.array([0.05 * np.cos(angle), 0.05 * np.sin(angle), -0.03]),
            spring(4e3, 3e3, 9e3), damping=spring(3.0, 3.0, 5.0),
            axes=Rotation.from_euler("z", angle).as_matrix(),
        )
        for number, angle in enumerate(angles)
    ]  # fmt: skip
    grommets = [
        Bushing(
            f"grommet_{number}", "shell", None,
            np.array([0.1 * np.cos(angle), 0.1 * np.sin(angle), -0.08]),
            spring(2e4, 2e4, 5e4), loss_factor_ratio=0.1,
        )
        for number, angle in enumerate(angles)
    ]  # fmt: skip
    discharge = Bushing("tube", "block", "shell", np.array([0.08, 0.0, 0.02]), tube)
    return Isolation((block, shell), (*springs, *grommets, discharge))


def some_load() -> np.ndarray:
    rng = np.random.default_rng(5)
    return rng.normal(size=(2, 6)) + 1j * rng.normal(size=(2, 6))


def bushing_force(isolation: Isolation, load: np.ndarray, frequency: float) -> np.ndarray:
    return isolation.bushing_force(isolation.displacement(load, frequency), frequency)


# --- one body ------------------------------------------------------------------------------------


def test_one_body_on_grommets_against_its_equations():
    """Newton and Euler written out: a foot moves by t + r x p and pushes back with k (1 + jη)."""
    grommets = Mounts(
        pitch_m=0.19,
        lateral_stiffness_n_per_m=2e4,
        vertical_stiffness_n_per_m=5e4,
        loss_factor_ratio=0.1,
    )
    housing = Housing(
        mass_kg=35.0, inertia_xx_kg_m2=0.57, inertia_yy_kg_m2=0.5, inertia_zz_kg_m2=0.12
    )
    feet = [np.array([x, y, -0.19]) for x in (0.095, -0.095) for y in (0.095, -0.095)]
    frequency = np.array([0.0, 4.0, 12.0, 50.0, 400.0])
    load = some_load()[0]
    response = MachineOnMounts(housing, grommets, -0.19).response(load * np.ones((5, 1)), frequency)
    mass = np.array([35.0, 35.0, 35.0, 0.57, 0.5, 0.12])
    for at, omega in enumerate(2.0 * np.pi * frequency):
        stiffness = np.array([2e4, 2e4, 5e4]) * (1.0 + (0.1j if omega else 0.0))

        def foot_forces(motion, stiffness=stiffness):
            return np.array([stiffness * (motion[:3] + np.cross(motion[3:], p)) for p in feet])

        def left_over(motion, omega=omega, foot_forces=foot_forces):
            force = foot_forces(motion)
            moment = np.cross(feet, force).sum(axis=0)
            return np.concatenate([force.sum(axis=0), moment]) - omega**2 * mass * motion

        motion = np.linalg.solve(np.array([left_over(unit) for unit in np.eye(6)]).T, load)
        np.testing.assert_allclose(response.velocity[at], 1j * omega * motion, rtol=ROUNDING)
        force = foot_forces(motion)
        np.testing.assert_allclose(
            response.foot_force[at], force, atol=ROUNDING * np.max(np.abs(force))
        )
    np.testing.assert_array_equal(response.block_velocity, response.velocity)


# --- two stages ----------------------------------------------------------------------------------


def test_matrices_are_symmetric_and_hold_the_bodies(two_stage):
    for matrix in (two_stage.mass_matrix, two_stage.stiffness_matrix, two_stage.damping_matrix):
        np.testing.assert_allclose(matrix, matrix.T, atol=1e-12 * np.max(np.abs(matrix)))
    assert np.all(np.linalg.eigvalsh(two_stage.stiffness_matrix) > 0.0)


def test_modes_solve_the_eigenvalue_problem(two_stage):
    frequency, shape = two_stage.natural_modes()
    flat = shape.reshape(12, 12).T
    np.testing.assert_allclose(flat.T @ two_stage.mass_matrix @ flat, np.eye(12), atol=ROUNDING)
    stiffness = flat.T @ two_stage.stiffness_matrix @ flat
    squares = (2.0 * np.pi * frequency) ** 2
    np.testing.assert_allclose(stiffness, np.diag(squares), atol=ROUNDING * squares[-1])


def test_two_masses_in_a_line_by_hand():
    """Vertical only: m1 ẍ1 = -k1 (x1 - x2), m2 ẍ2 = k1 (x1 - x2) - k2 x2."""
    bodies = tuple(
        RigidBody(name, mass, 0.01 * np.eye(3), np.zeros(3))
        for name, mass in (("block", 2.0), ("shell", 3.0))
    )
    rotation = np.full(3, 1e6)
    bushings = (
        Bushing("spring", "block", "shell", np.zeros(3), np.diag([1e6, 1e6, 1e3, *rotation])),
        Bushing("foot", "shell", None, np.zeros(3), np.diag([1e6, 1e6, 4e3, *rotation])),
    )
    half_sum = (1e3 / 2.0 + 5e3 / 3.0) / 2.0
    root = np.sqrt(half_sum**2 - 1e3 * 4e3 / 6.0)
    by_hand = np.sqrt([half_sum - root, half_sum + root]) / (2.0 * np.pi)
    frequency, _ = Isolation(bodies, bushings).natural_modes()
    np.testing.assert_allclose(frequency[:2], by_hand, rtol=ROUNDING)


def test_reciprocity(two_stage):
    """Motion of body i per load on j equals motion of j per load on i."""
    unit = np.eye(12).reshape(12, 2, 6)
    for frequency in (0.0, 7.0, 49.2, 350.0):
        receptance = two_stage.displacement(unit, frequency).reshape(12, 12)
        np.testing.assert_allclose(
            receptance, receptance.T, atol=ROUNDING * np.max(np.abs(receptance))
        )


def test_static_limit(two_stage):
    """At 0 Hz K x = F; towards 0 Hz the undamped part of the motion meets it."""
    load = some_load().real
    static = two_stage.displacement(load, 0.0)
    np.testing.assert_allclose(two_stage.stiffness_matrix @ static.ravel(), load.ravel(), rtol=1e-8)
    lossless = Isolation(
        two_stage.bodies,
        tuple(
            Bushing(b.name, b.body, b.other_body, b.position_m, b.stiffness, axes=b.axes)
            for b in two_stage.bushings
        ),
    )
    lowest = lossless.natural_modes()[0][0]
    slow = lossless.displacement(load, 1e-3 * lowest)
    # The mode of the lowest frequency is magnified by 1/(1 - 1e-6), the others by less.
    np.testing.assert_allclose(slow, static, atol=2e-6 * np.max(np.abs(static)))


def test_ground_carries_a_static_load(two_stage):
    """Forces and moments on the ground, about the origin, are those of the loads."""
    load = some_load().real
    force = bushing_force(two_stage, load, 0.0)
    into_ground = [n for n, b in enumerate(two_stage.bushings) if b.other_body is None]
    places = np.array([two_stage.bushings[n].position_m for n in into_ground])
    centres = np.array([body.centre_of_mass_m for body in two_stage.bodies])
    passed = force[into_ground]
    np.testing.assert_allclose(passed[:, :3].sum(0), load[:, :3].sum(0), rtol=1e-9)
    np.testing.assert_allclose(
        (passed[:, 3:] + np.cross(places, passed[:, :3])).sum(0),
        (load[:, 3:] + np.cross(centres, load[:, :3])).sum(0),
        rtol=1e-8,
    )


@pytest.mark.parametrize("frequency", [3.0, 49.2, 700.0])
def test_momentum(two_stage, frequency):
    """Loads less the forces into the ground change the momentum, linear and angular."""
    load = some_load()
    force = bushing_force(two_stage, load, frequency)
    acceleration = -((2.0 * np.pi * frequency) ** 2) * two_stage.displacement(load, frequency)
    centres = np.array([body.centre_of_mass_m for body in two_stage.bodies])
    masses = np.array([[body.mass_kg] for body in two_stage.bodies])
    rate = masses * acceleration[:, :3]
    spin = sum(
        body.inertia_kg_m2 @ acceleration[n, 3:] for n, body in enumerate(two_stage.bodies)
    ) + np.cross(centres, rate).sum(0)
    outside, moment = load[:, :3].sum(0), (load[:, 3:] + np.cross(centres, load[:, :3])).sum(0)
    for bushing, passed in zip(two_stage.bushings, force, strict=True):
        if bushing.other_body is None:
            outside = outside - passed[:3]
            moment = moment - passed[3:] - np.cross(bushing.position_m, passed[:3])
    np.testing.assert_allclose(outside, rate.sum(0), atol=1e-9 * np.max(np.abs(rate)))
    np.testing.assert_allclose(moment, spin, atol=1e-9)


def test_power_put_in_is_lost_in_the_bushings(two_stage):
    load, frequency = some_load(), 30.0
    omega = 2.0 * np.pi * frequency
    motion = two_stage.displacement(load, frequency).ravel()
    put_in = 0.5 * np.real(np.vdot(1j * omega * motion, load.ravel()))
    loss = omega * two_stage.damping_matrix + two_stage.structural_damping_matrix
    assert put_in == pytest.approx(0.5 * omega * np.real(np.vdot(motion, loss @ motion)), rel=1e-9)
    assert put_in > 0.0


def test_time_integration(two_stage):
    """SciPy's integration of M ẍ + C ẋ + K x = Re{F e^jωt} from the periodic state stays on it."""
    viscous = Isolation(
        two_stage.bodies,
        tuple(
            Bushing(b.name, b.body, b.other_body, b.position_m, b.stiffness,
                    damping=2e-4 * b.stiffness, axes=b.axes)
            for b in two_stage.bushings
        ),
    )  # fmt: skip
    load, frequency = some_load(), 40.0
    omega = 2.0 * np.pi * frequency
    motion = viscous.displacement(load, frequency).ravel()
    inverse = np.linalg.inv(viscous.mass_matrix)
    k, c = inverse @ viscous.stiffness_matrix, inverse @ viscous.damping_matrix
    drive = inverse @ load.ravel()

    def rate(t, state):
        acceleration = np.real(drive * np.exp(1j * omega * t)) - k @ state[:12] - c @ state[12:]
        return np.concatenate([state[12:], acceleration])

    start = np.concatenate([motion.real, np.real(1j * omega * motion)])
    times = np.linspace(0.0, 3.0 / frequency, 37)
    found = solve_ivp(
        rate, (0.0, times[-1]), start, t_eval=times, rtol=1e-10, atol=1e-14, method="DOP853"
    )
    expected = np.real(motion[:, None] * np.exp(1j * omega * times))
    # A wrong phasor would start a transient of its own size within the three periods.
    np.testing.assert_allclose(found.y[:12], expected, atol=1e-7 * np.max(np.abs(expected)))


def test_turned_bushing_is_the_turned_machine(two_stage):
    """Turning everything turns the answer."""
    turn = Rotation.from_euler("xyz", [0.3, -0.8, 1.2]).as_matrix()
    bodies = tuple(
        RigidBody(b.name, b.mass_kg, turn @ b.inertia_kg_m2 @ turn.T, turn @ b.centre_of_mass_m)
        for b in two_stage.bodies
    )
    bushings = tuple(
        Bushing(b.name, b.body, b.other_body, turn @ b.position_m, b.stiffness, b.damping,
                b.loss_factor_ratio, turn @ b.axes)
        for b in two_stage.bushings
    )  # fmt: skip
    both = np.kron(np.eye(2), turn)
    load = some_load()
    expected = two_stage.displacement(load, 30.0) @ both.T
    found = Isolation(bodies, bushings).displacement(load @ both.T, 30.0)
    np.testing.assert_allclose(found, expected, atol=ROUNDING * np.max(np.abs(expected)))


def test_other_body_takes_the_opposite_part(two_stage):
    """Naming a bushing's bodies the other way round turns the sign of its force, nothing else."""
    swapped = tuple(
        Bushing(b.name, b.other_body, b.body, b.position_m, b.stiffness, b.damping,
                b.loss_factor_ratio, b.axes) if b.other_body else b
        for b in two_stage.bushings
    )  # fmt: skip
    other = Isolation(two_stage.bodies, swapped)
    sign = np.array([-1.0 if b.other_body else 1.0 for b in two_stage.bushings])
    np.testing.assert_allclose(
        bushing_force(other, some_load(), 20.0),
        sign[:, None] * bushing_force(two_stage, some_load(), 20.0),
        rtol=1e-9,
        atol=1e-12,
    )


def test_second_stage_isolates_above_both_resonances(two_stage):
    """The force into the ground falls by the mass law of the shell against a block alone."""
    block = two_stage.bodies[0]
    alone = Isolation(
        (block,),
        tuple(
            Bushing(b.name, "block", None, b.position_m, b.stiffness, b.damping, axes=b.axes)
            for b in two_stage.bushings
            if b.other_body == "shell" and b.name != "tube"
        ),
    )
    load = np.zeros((2, 6))
    load[0, 2] = 1.0
    single = np.abs(bushing_force(alone, load[:1], 500.0)[:, 2].sum())
    grommets = [n for n, b in enumerate(two_stage.bushings) if b.other_body is None]
    double = np.abs(bushing_force(two_stage, load, 500.0)[grommets, 2].sum())
    assert double < 0.1 * single


# --- free bodies, bad input ----------------------------------------------------------------------


def test_a_free_body_moves_by_its_mass():
    body = RigidBody("block", 2.0, 0.01 * np.eye(3), np.zeros(3))
    free = Isolation((body,), ())
    np.testing.assert_array_equal(free.natural_modes()[0], 0.0)
    load = np.array([[4.0, 0, 0, 0, 0, 0.1]])
    omega = 2.0 * np.pi * 50.0
    np.testing.assert_allclose(
        free.displacement(load, 50.0) * -(omega**2), [[2.0, 0, 0, 0, 0, 10.0]], rtol=1e-12
    )
    assert bushing_force(free, load, 50.0).shape == (0, 6)
    with pytest.raises(SolverError, match="move freely"):
        free.displacement(load, 0.0)


def body(**change) -> RigidBody:
    given_values = {
        "name": "block", "mass_kg": 1.0, "inertia_kg_m2": np.eye(3),
        "centre_of_mass_m": np.zeros(3),
    }  # fmt: skip
    return RigidBody(**(given_values | change))


def bushing(**change) -> Bushing:
    given_values = {
        "name": "spring", "body": "block", "other_body": None, "position_m": np.zeros(3),
        "stiffness": np.eye(6),
    }  # fmt: skip
    return Bushing(**(given_values | change))


SKEW = np.eye(6) + np.eye(6, k=1)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: body(mass_kg=0.0), "body block: mass_kg"),
        (lambda: body(mass_kg=np.nan), "body block: mass_kg"),
        (lambda: body(inertia_kg_m2=np.diag([1.0, 1.0, 3.0])), "body block: inertia_kg_m2"),
        (lambda: body(inertia_kg_m2=np.diag([1.0, 1.0, 0.0])), "body block: inertia_kg_m2"),
        (lambda: body(centre_of_mass_m=np.zeros(2)), "body block: centre_of_mass_m"),
        (lambda: bushing(stiffness=SKEW), "bushing spring: stiffness: must be symmetric"),
        (lambda: bushing(stiffness=-np.eye(6)), "bushing spring: stiffness: must be positive"),
        (lambda: bushing(damping=-np.eye(6)), "bushing spring: damping: must be positive"),
        (lambda: bushing(axes=np.diag([1.0, 1.0, -1.0])), "bushing spring: axes"),
        (lambda: bushing(loss_factor_ratio=-0.1), "bushing spring: loss_factor_ratio"),
        (lambda: Isolation((), ()), "bodies"),
        (lambda: Isolation((body(), body()), ()), "body block: named twice"),
        (lambda: Isolation((body(),), (bushing(), bushing())), "bushing spring: named twice"),
        (lambda: Isolation((body(),), (bushing(other_body="hood"),)), "no body hood"),
        (lambda: Isolation((body(),), (bushing(other_body="block"),)), "block to itself"),
    ],
)
def test_bad_input_is_named(make, words):
    with pytest.raises(ParameterError, match=words):
        make()


def test_rounding_of_a_rotation_is_no_asymmetry():
    """Between bodies that are stiff along their axes alone: zeros beside what rounding leaves."""
    rounded = np.eye(6)
    rounded[0, 1] = np.finfo(float).eps
    assert bushing(stiffness=rounded).stiffness[0, 1] > 0.0
    assert body(inertia_kg_m2=rounded[:3, :3]).inertia_kg_m2[0, 1] > 0.0


def test_undamped_resonance_is_refused():
    block = RigidBody("block", 1.0, np.eye(3), np.zeros(3))
    stiff = (2.0 * np.pi) ** 2 * np.eye(6)
    isolation = Isolation((block,), (bushing(stiffness=stiff),))
    with pytest.raises(SolverError, match="damping"):
        isolation.displacement(np.ones((1, 6)), 1.0)


# --- tube ----------------------------------------------------------------------------------------


def test_straight_tube_is_the_beam_of_the_textbook():
    """12 EI/L³, 6 EI/L², 4 EI/L, GJ/L, EA/L (Euler-Bernoulli)."""
    length, outer, inner = 0.3, 5e-3, 3.6e-3
    stiffness = tube_stiffness(
        np.array([[0.0, 0, 0], [length, 0, 0]]), outer, inner, STEEL_PA, POISSON
    )
    bending = STEEL_PA * np.pi / 64.0 * (outer**4 - inner**4)
    expected = np.zeros((6, 6))
    np.fill_diagonal(
        expected,
        [STEEL_PA * np.pi / 4.0 * (outer**2 - inner**2) / length]
        + [12.0 * bending / length**3] * 2
        + [bending / (1.0 + POISSON) / length]
        + [4.0 * bending / length] * 2,
    )
    expected[1, 5] = expected[5, 1] = -6.0 * bending / length**2
    expected[2, 4] = expected[4, 2] = 6.0 * bending / length**2
    np.testing.assert_allclose(stiffness, expected, rtol=1e-9, atol=1e-9)


def test_coil_spring_is_the_formula_of_the_textbook():
    """k = G d⁴ / (8 D³ n) for a close coil; the pitch p adds terms of (p / π D)²."""
    wire, diameter, turns, pitch = 1e-3, 2e-2, 6, 1.2e-3
    angle = np.linspace(0.0, 2.0 * np.pi * turns, 400 * turns + 1)
    helix = np.stack(
        [diameter / 2 * np.cos(angle), diameter / 2 * np.sin(angle), pitch * angle / (2 * np.pi)], 1
    )
    axial = tube_stiffness(helix, wire, 0.0, STEEL_PA, POISSON)[2, 2]
    formula = STEEL_PA / 2.6 * wire**4 / (8.0 * diameter**3 * turns)
    slope = pitch / (np.pi * diameter)
    # Tension of the wire adds (d/D)²/(4 (1 + ν)) of 1/k, the polyline (π/400)²/2 of its length.
    tolerance = 2.0 * slope**2 + (wire / diameter) ** 2 + (np.pi / 400) ** 2
    assert axial == pytest.approx(formula, rel=tolerance)


def test_pieces_of_a_straight_tube_add_up():
    whole = tube_stiffness(np.array([[0.0, 0, 0], [0.3, 0.1, 0.2]]), 5e-3, 4e-3, STEEL_PA, POISSON)
    points = np.linspace(0.0, 1.0, 8)[:, None] * np.array([0.3, 0.1, 0.2])
    parts = tube_stiffness(points, 5e-3, 4e-3, STEEL_PA, POISSON)
    np.testing.assert_allclose(parts, whole, rtol=1e-8, atol=1e-9 * np.max(whole))


@given(
    outer=st.floats(allow_nan=True, allow_infinity=True),
    inner=st.floats(allow_nan=True, allow_infinity=True),
)
def test_a_wrong_tube_is_refused_or_gives_a_stiffness(outer, inner):
    straight = np.array([[0.0, 0, 0], [0.3, 0, 0]])
    try:
        stiffness = tube_stiffness(straight, outer, inner, STEEL_PA, POISSON)
    except ParameterError:
        assert not 0.0 <= inner <= 0.999 * outer or not 1e-5 <= outer <= 1.0
    else:
        assert np.all(np.isfinite(stiffness))
        assert np.all(np.diag(stiffness) > 0.0)


@pytest.mark.parametrize(
    ("path", "words"),
    [(np.zeros((2, 3)), "coincide"), (np.zeros((1, 3)), "path_m"), (np.zeros((2, 2)), "path_m")],
)
def test_a_wrong_path_is_refused(path, words):
    with pytest.raises(ParameterError, match=words):
        tube_stiffness(path, 5e-3, 3e-3, STEEL_PA, POISSON)
