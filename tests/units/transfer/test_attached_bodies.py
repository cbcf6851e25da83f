"""Bodies that options attach: against matrices made by hand, limits, keys, refusals."""

from itertools import pairwise
from typing import ClassVar

import numpy as np
import pytest
import xarray as xr
from body_matrices import Mass, Spring, assembled, foot_forces, mass_of, natural_hz, on_feet, solved
from sources_study import SOURCES_STUDY
from support import MACHINE_FILE, ROOT, TINY

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.vocabulary import stamp
from vibroacoustics.machine.cases import Cases
from vibroacoustics.machine.feet import MountStiffness
from vibroacoustics.machine.option import Option
from vibroacoustics.machine.suspension import BLOCK
from vibroacoustics.mechanics.bushings import AttachedBodies, Bushing, RigidBody
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.results.words import words
from vibroacoustics.sources.cases import cases_of
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.transfer import on_mounts
from vibroacoustics.transfer.transient import transient
from vibroacoustics.transfer.tube import tube_stiffness
from vibroacoustics.uncertainty.sampled_cases import sampled_cases

MACHINE = load_machine(MACHINE_FILE)
HERMETIC = load_machine(ROOT / "data" / "machines" / "dagilis_slider_link.toml")
CENTRE = np.array([0.08, -0.03, 0.12])
POINT = np.array([0.07, -0.03, 0.10])
INERTIA = np.array([[3e-3, 2e-4, 0.0], [2e-4, 4e-3, -3e-4], [0.0, -3e-4, 5e-3]])
LOAD = np.array([3.0, -2.0 + 1.0j, 4.0, 0.3j, -0.2, 0.5])
CLOSE = 1e-9
"""Of the largest magnitude: eps times a condition number of up to 1e6."""


def stiffness_by(scale: float = 1.0) -> np.ndarray:
    """Symmetric and positive definite, all entries filled, N/m, N and N m."""
    root = np.random.default_rng(3).standard_normal((6, 6))
    size = np.diag([200.0, 250.0, 300.0, 12.0, 11.0, 10.0])
    return scale * size @ (np.eye(6) + 0.05 * root @ root.T) @ size


def attached(port=HOUSING, mass_kg=2.0, scale=1.0, share=1.0, loss=0.08) -> AttachedBodies:
    """One body off the centre of mass on one rubber with all couplings."""
    body = RigidBody("damper", mass_kg, share * INERTIA, CENTRE)
    stiffness = stiffness_by(scale)
    rubber = Bushing("rubber", "damper", port.name, POINT, stiffness, loss_factor_ratio=loss)
    return AttachedBodies((body,), (rubber,))


def check_response(body, masses, springs, load, hertz):
    """Velocity of the housing and foot forces; the load is on all bodies."""
    mass, stiffness = assembled(masses, springs)
    moved = solved(mass, stiffness, load, hertz)
    velocity = 2j * np.pi * hertz * moved[:6]
    response = body.response(LOAD, hertz)
    np.testing.assert_allclose(
        response.velocity, velocity, rtol=0.0, atol=CLOSE * abs(velocity).max()
    )
    force = foot_forces(springs, moved)
    np.testing.assert_allclose(response.foot_force, force, rtol=0.0, atol=CLOSE * abs(force).max())
    return mass, stiffness


# --- matrices made by hand -----------------------------------------------------------------------


@pytest.mark.parametrize("hertz", [4.0, 21.0, 48.3, 300.0])
def test_response_and_modes_are_those_of_twelve_degrees_of_freedom(hertz):
    body = on_mounts(MACHINE.carrying(attached()))
    masses = [mass_of(MACHINE.housing), Mass(2.0, INERTIA, CENTRE)]
    springs = [*on_feet(MACHINE), Spring(1, 0, POINT, (1.0 + 0.08j) * stiffness_by())]
    load = np.concatenate([LOAD, np.zeros(6)])
    matrices = check_response(body, masses, springs, load, hertz)
    expected = natural_hz(*matrices)
    found = body.natural_modes()[0]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=CLOSE * expected.max())


@pytest.mark.parametrize("hertz", [4.0, 21.0, 48.3, 300.0])
@pytest.mark.parametrize("port", [HOUSING, BLOCK])
def test_response_and_modes_with_a_block_on_springs(port, hertz):
    """Three bodies: the load is on the block, which is neither the first nor the last."""
    body = on_mounts(HERMETIC.carrying(attached(port)))
    inside = HERMETIC.suspension
    height = np.array([0.0, 0.0, inside.height_m])
    masses = [mass_of(HERMETIC.housing), mass_of(inside.block, height), Mass(2.0, INERTIA, CENTRE)]
    springs = [*on_feet(HERMETIC)]
    inner, half = inside.springs, 0.5 * inside.springs.pitch_m
    lateral, vertical = inner.lateral_stiffness_n_per_m, inner.vertical_stiffness_n_per_m
    loss = 1.0 + 1j * inner.loss_factor_ratio
    for x in (half, -half):
        for y in (half, -half):
            point = height + np.array([x, y, inside.springs_height_m])
            each = loss * np.diag([lateral, lateral, vertical, 0.0, 0.0, 0.0])
            springs.append(Spring(1, 0, point, each))
    tube = inside.discharge_tube
    path = height + np.array([tube.x_m, tube.y_m, tube.z_m]).T
    values = (tube.outer_diameter_m, tube.inner_diameter_m, tube.youngs_modulus_pa)
    of_tube = tube_stiffness(path, *values, tube.poisson_ratio)
    springs.append(Spring(1, 0, path[-1], (1.0 + 1j * tube.loss_factor_ratio) * of_tube))
    to = 0 if port == HOUSING else 1
    springs.append(Spring(2, to, POINT, (1.0 + 0.08j) * stiffness_by()))
    load = np.concatenate([np.zeros(6), LOAD, np.zeros(6)])
    matrices = check_response(body, masses, springs, load, hertz)
    expected = natural_hz(*matrices)
    found = body.natural_modes()[0]
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=CLOSE * expected.max())
    assert body.labels == ["shell", "block", "damper"]


def test_viscous_damper_in_its_own_axes():
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    damping = np.diag([5.0, 60.0, 7.0, 0.1, 0.2, 0.3])
    (body,), stiffness = attached().bodies, stiffness_by()
    rubber = Bushing("rubber", "damper", HOUSING.name, POINT, stiffness, damping, axes=turn)
    machine = on_mounts(MACHINE.carrying(AttachedBodies((body,), (rubber,))))
    both = np.kron(np.eye(2), turn)
    held = both @ (stiffness + 2j * np.pi * 30.0 * damping) @ both.T
    masses = [mass_of(MACHINE.housing), Mass(2.0, INERTIA, CENTRE)]
    springs = [*on_feet(MACHINE), Spring(1, 0, POINT, held)]
    check_response(machine, masses, springs, np.concatenate([LOAD, np.zeros(6)]), 30.0)


def test_transient_holds_the_attached_body():
    """A whole number of periods of a sine is the steady response at its frequency."""
    machine = on_mounts(MACHINE.carrying(attached()))
    times, rate, hertz = 8192, 4096.0, 24.0
    phase = 2.0 * np.pi * hertz * np.arange(times) / rate
    load = (LOAD[:, None] * np.exp(1j * phase)).real
    found = transient(machine, load, rate, lambda f: np.zeros((1, 6, f.size), complex))
    expected = (machine.response(LOAD, hertz).foot_force[..., None] * np.exp(1j * phase[::2])).real
    np.testing.assert_allclose(
        found.foot_force_n, expected, rtol=0.0, atol=CLOSE * abs(expected).max()
    )
    alone = on_mounts(MACHINE).response(LOAD, hertz).foot_force
    assert np.max(np.abs(alone - machine.response(LOAD, hertz).foot_force)) > 1e-3


# --- limits --------------------------------------------------------------------------------------


def size_of_change(carried: AttachedBodies, expected: np.ndarray) -> float:
    force = on_mounts(MACHINE.carrying(carried)).response(LOAD, 30.0).foot_force
    return float(np.linalg.norm(force - expected) / np.linalg.norm(expected))


def test_without_mass_there_is_no_body():
    """Mass and stiffness in one ratio: what is changed falls as the mass does.

    The next term of the series is as small against the first as that against one.
    """
    alone = on_mounts(MACHINE).response(LOAD, 30.0).foot_force
    changes = [
        size_of_change(attached(mass_kg=2.0 * part, scale=part, share=part), alone)
        for part in (1e-4, 1e-5, 1e-6)
    ]
    assert changes[0] < 1e-2
    for more, less in pairwise(changes):
        assert more / less == pytest.approx(10.0, rel=10.0 * more)


def test_on_a_stiff_bushing_it_is_part_of_the_housing():
    """The difference to one rigid body falls as the bushing's flexibility does."""
    masses = [mass_of(MACHINE.housing), Mass(2.0, INERTIA, CENTRE)]
    mass, stiffness = assembled(masses, on_feet(MACHINE))
    along = np.eye(6)
    for axis in range(3):
        along[:3, 3 + axis] = np.cross(np.eye(3)[axis], CENTRE)
    one = np.vstack([np.eye(6), along])  # both bodies by the motion of the housing
    moved = solved(one.T @ mass @ one, one.T @ stiffness @ one, LOAD, 30.0)
    expected = foot_forces(on_feet(MACHINE), moved)
    changes = [size_of_change(attached(scale=scale), expected) for scale in (1e3, 1e4, 1e5)]
    assert changes[0] < 1e-2
    for more, less in pairwise(changes):
        assert more / less == pytest.approx(10.0, rel=10.0 * more)


def along_x_and_y(loss: float, hertz: float) -> float:
    """Velocity of the point of a damper that is tuned along x and y to 30 Hz."""
    stiffness = 2.0 * (2.0 * np.pi * 30.0) ** 2 * np.diag([1.0, 1.0, 1e4, 10.0, 10.0, 10.0])
    (body,) = attached().bodies
    spring = Bushing("spring", "damper", HOUSING.name, CENTRE, stiffness, loss_factor_ratio=loss)
    carrying = MACHINE.carrying(AttachedBodies((body,), (spring,)))
    velocity = on_mounts(carrying).response(LOAD, hertz).velocity
    return float(np.linalg.norm((velocity[:3] + np.cross(velocity[3:], CENTRE))[:2]))


def test_line_falls_with_the_loss_at_the_tuned_frequency_alone():
    """The dynamic stiffness of the damper there is -m ω² (1 + jη)/(jη); η times less moves."""
    moved = [along_x_and_y(loss, 30.0) for loss in (1e-2, 1e-3, 1e-4)]
    small = moved[0] / along_x_and_y(1e-2, 36.0)
    assert small < 0.2
    assert moved[0] / moved[1] == pytest.approx(10.0, rel=10.0 * small)
    assert moved[1] / moved[2] == pytest.approx(10.0, rel=small)
    elsewhere = [along_x_and_y(loss, 36.0) for loss in (1e-3, 1e-4)]
    assert elsewhere[0] == pytest.approx(elsewhere[1], rel=0.02)


# --- keys and refusals ---------------------------------------------------------------------------


def test_machines_with_different_bodies_are_different():
    carrying = MACHINE.carrying(attached())
    assert on_mounts(carrying) != on_mounts(MACHINE)
    assert on_mounts(carrying) is on_mounts(MACHINE.carrying(attached()))
    for other in (attached(scale=2.0), attached(mass_kg=3.0), attached(loss=0.1), attached(BLOCK)):
        assert other != attached()
    assert on_mounts(MACHINE.carrying(attached(scale=1.0 + 1e-12))) != on_mounts(carrying)
    assert carrying.carrying(AttachedBodies()).attached == AttachedBodies()
    assert MACHINE.carrying(AttachedBodies()) is MACHINE


def test_changed_tables_keep_the_bodies_and_files_know_none():
    carrying = MACHINE.carrying(attached())
    mounts = MACHINE.mounts.model_copy(update={"pitch_m": 0.3})
    assert carrying.model_copy(update={"mounts": mounts}).attached == attached()
    assert carrying.model_dump() == MACHINE.model_dump()


def renamed(**changes) -> AttachedBodies:
    (body,), (rubber,) = attached().bodies, attached().bushings
    values = {"name": "rubber", "body": "damper", "other_body": "housing", **changes}
    joint = Bushing(**values, position_m=POINT, stiffness=rubber.stiffness)
    return AttachedBodies((body,), (joint,))


@pytest.mark.parametrize(
    ("bodies", "said"),
    [
        (lambda: attached(BLOCK), "bushing rubber: no body block; there are housing, damper"),
        (lambda: renamed(other_body="damper"), "bushing rubber: joins damper to itself"),
        (lambda: renamed(other_body=None), "bushing rubber: other_body = None: must be a body"),
        (lambda: AttachedBodies(attached().bodies), "body damper: its bushings leave it free"),
    ],
)
def test_bodies_that_do_not_fit_are_refused(bodies, said):
    with pytest.raises(ParameterError, match=f"^{said}"):
        MACHINE.carrying(bodies())


def test_body_held_along_one_axis_alone_is_free():
    along = np.diag([0.0, 0.0, 1e4, 0.0, 0.0, 0.0])
    spring = Bushing("spring", "damper", HOUSING.name, CENTRE, along)
    with pytest.raises(ParameterError, match=r"^body damper: its bushings leave it free to move; "):
        AttachedBodies(attached().bodies, (spring,))


def test_body_is_free_where_a_stiffness_is_rounding_beside_the_others():
    """ω² about z is 1e-13 of that along the axes: 1e-9 of 1e4 1/s²."""
    along, about = 2.0 * 1e4, 4e-3 * 1e4
    body = RigidBody("damper", 2.0, 4e-3 * np.eye(3), CENTRE)
    held = np.diag([along, along, along, about, about, 1e-13 * about])
    spring = Bushing("spring", "damper", HOUSING.name, CENTRE, held)
    with pytest.raises(ParameterError, match="its bushings leave it free to move"):
        AttachedBodies((body,), (spring,))


def test_modes_on_mounts_over_frequency_with_a_stiff_bushing(tmp_path):
    """Far above the highest mode on mounts; a table of constants gives the constant's modes."""
    mounts = MACHINE.mounts
    rows = "".join(
        f"{hertz},{mounts.lateral_stiffness_n_per_m / 1e3!r},"
        f"{mounts.vertical_stiffness_n_per_m / 1e3!r},{mounts.loss_factor_ratio!r}\n"
        for hertz in (0, 1000)
    )
    head = "frequency_hz,lateral_n_per_mm,vertical_n_per_mm,loss_factor\n"
    (tmp_path / "k.csv").write_text(head + rows)
    table = MountStiffness(file=str(tmp_path / "k.csv"))
    carrying = MACHINE.carrying(attached(scale=1e8))
    constant = on_mounts(carrying).natural_modes()[0]
    assert constant.max() > 1e5
    found = on_mounts(carrying.model_copy(update={"mount_stiffness": table})).natural_modes()[0]
    np.testing.assert_allclose(found, constant, rtol=0.0, atol=CLOSE * constant.max())


# --- in a study ----------------------------------------------------------------------------------


class Follower(Option):
    """A body of a part of the housing's mass."""

    kind: ClassVar[str] = "follower"

    def attached(self, machine):
        return attached(mass_kg=0.01 * machine.housing.mass_kg)


def following(study):
    return study.model_copy(update={"options": {**study.options, "follower": Follower()}})


def test_samples_reach_attached_bodies_and_their_mass():
    study = following(load_study(TINY))
    cases = cases_of(study, lambda *_: None)
    mass = study.machine.housing.mass_kg
    given = cases[2900.0, "follower"]
    assert given.added.figures["added_mass_kg"] == pytest.approx(0.01 * mass, rel=1e-12)
    assert cases[2900.0, "none"].added.figures == {"added_mass_kg": 0.0}
    assert given.revolution is cases[2900.0, "none"].revolution
    nominal = Cases(cases, {}, {key: {} for key in cases})
    sample = {("housing", "mass_kg"): 1.5 * mass}
    sampled = sampled_cases(nominal, study, sample).cases[2900.0, "follower"]
    assert sampled.machine.attached == attached(mass_kg=0.015 * mass)
    assert sampled.added.figures["added_mass_kg"] == pytest.approx(0.015 * mass, rel=1e-12)
    other = sampled_cases(nominal, study, {("mounts", "pitch_m"): 0.2}).cases[2900.0, "follower"]
    assert other.machine.attached == given.machine.attached


def test_option_whose_bodies_do_not_fit_is_refused_with_its_name():
    class Lost(Follower):
        def attached(self, machine):
            return attached(BLOCK)

    study = load_study(TINY)
    with pytest.raises(ValueError, match=r"options\.lost: bushing rubber: no body block"):
        type(study).model_validate({**dict(study), "options": {**study.options, "lost": Lost()}})


@pytest.mark.parametrize(
    ("file", "attaches"), [(SOURCES_STUDY, True), (SOURCES_STUDY, False), (TINY, True)]
)
def test_report_says_what_bodies_on_an_elastic_shell_do(file, attaches):
    """One sentence, where there are such bodies and a source drives the shell."""
    study = load_study(file)
    study = study.model_copy(update={"options": {"none": study.options["none"]}})
    assert study.drives_shell == (file == SOURCES_STUDY)
    speeds, options = list(study.operation.speed_rpm), list(study.options)
    figures = {"speed": speeds, "option": options, "figure": ["added_mass_kg"]}
    shape = (len(speeds), len(options), 1)
    results = stamp("reported_figure", np.zeros(shape), figures).to_dataset()
    if attaches:
        hertz = np.ones((len(options), 1))
        modes = {"option": options, "option_mode": ["mode_1"]}
        results = xr.merge([results, stamp("option_natural_frequency", hertz, modes)])
    said = words(study, {}, results)["leaves_out"]
    assert sum("act at the rigid motion of the housing" in text for text in said) == (
        attaches and study.drives_shell
    )
