"""Block on springs in a shell on grommets: limits, laws, and the report of its motion."""

import numpy as np
import pytest
from slider_link_files import STUDY
from slider_link_pairs import free_acceleration
from support import ROOT, made_up_radiation

from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.housing import Housing
from vibroacoustics.report.sections.mounts import block_table, modes_table
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.transfer import MachineOnMounts, on_mounts

MACHINE = load_machine(ROOT / "data" / "machines" / "dagilis_slider_link.toml")
FOOT_HEIGHT_M = -0.08
LOAD = np.array([3.0, -2.0 + 1.0j, 4.0, 0.3j, -0.2, 0.5])
"""Force and moment on the block, N and N m."""
ROUNDING = 1e-10
"""Rounding of a 12 x 12 solve: eps times a condition number of up to 1e5."""


def suspended(tube: bool = True, **springs: float) -> MachineOnMounts:
    """The machine's block, with springs changed, with or without the discharge tube."""
    inside = MACHINE.suspension
    changed = {"springs": inside.springs.model_copy(update=springs)}
    if not tube:
        changed["discharge_tube"] = None
    return MachineOnMounts(
        MACHINE.housing, MACHINE.mounts, FOOT_HEIGHT_M, inside.model_copy(update=changed)
    )


def on_springs(stiffness_n_per_m: float) -> MachineOnMounts:
    """Without a tube, on springs of one stiffness in all directions."""
    return suspended(
        tube=False,
        lateral_stiffness_n_per_m=stiffness_n_per_m,
        vertical_stiffness_n_per_m=stiffness_n_per_m,
    )


def relative(found: np.ndarray, expected: np.ndarray) -> float:
    return float(np.linalg.norm(found - expected) / np.linalg.norm(expected))


# --- limits --------------------------------------------------------------------------------------


def one_body() -> tuple[MachineOnMounts, float]:
    """Shell and block as one rigid body, and the height of its centre of mass over the shell's."""
    shell, block = MACHINE.housing, MACHINE.suspension.block
    mass = shell.mass_kg + block.mass_kg
    height = block.mass_kg * MACHINE.suspension.height_m / mass
    above = MACHINE.suspension.height_m - height
    tilting = shell.mass_kg * height**2 + block.mass_kg * above**2  # parallel axes
    body = Housing(
        mass_kg=mass,
        inertia_xx_kg_m2=shell.inertia_xx_kg_m2 + block.inertia_xx_kg_m2 + tilting,
        inertia_yy_kg_m2=shell.inertia_yy_kg_m2 + block.inertia_yy_kg_m2 + tilting,
        inertia_zz_kg_m2=shell.inertia_zz_kg_m2 + block.inertia_zz_kg_m2,
    )
    return MachineOnMounts(body, MACHINE.mounts, FOOT_HEIGHT_M - height), above


def test_stiff_springs_make_one_rigid_body():
    """The difference falls with the springs' flexibility, ten times by ten times."""
    rigid, above = one_body()
    load = LOAD.copy()
    load[3:] += np.cross([0.0, 0.0, above], LOAD[:3])
    for frequency in (5.0, 50.0):
        expected = rigid.response(load, frequency).foot_force
        apart = [
            relative(on_springs(stiffness).response(LOAD, frequency).foot_force, expected)
            for stiffness in (1e7, 1e8, 1e9)
        ]
        # The next term of the series is as small against the first as that against one.
        assert apart[0] / apart[1] == pytest.approx(10.0, rel=3.0 * apart[0])
        assert apart[1] / apart[2] == pytest.approx(10.0, rel=3.0 * apart[1])


def test_stiff_springs_leave_the_six_modes_of_one_body():
    rigid, _ = one_body()
    modes = on_springs(1e9).isolation.natural_modes()[0]
    # The springs' share of a mode's energy is (f / f of the first mode against the springs)².
    slack = (modes[5] / modes[6]) ** 2
    assert slack < 1e-3
    np.testing.assert_allclose(modes[:6], rigid.isolation.natural_modes()[0], rtol=slack)


def test_soft_springs_isolate():
    """The feet's force and what the block lacks to a free one fall with the springs' stiffness.

    Both are series in the stiffness: ten times less of it makes ten times less of both, but for
    the second term, which is ten times less again.
    """
    block = MACHINE.suspension.block
    free = free_acceleration(block, LOAD) / (2j * np.pi * 50.0)
    bodies = [on_springs(stiffness) for stiffness in (20.0, 200.0, 2000.0)]
    feet = [np.linalg.norm(body.response(LOAD, 50.0).foot_force) for body in bodies]
    lacks = [relative(body.response(LOAD, 50.0).block_velocity, free) for body in bodies]
    for found in (feet, lacks):
        second = [found[number + 1] / found[number] - 10.0 for number in (0, 1)]
        assert abs(second[1]) < 1.0
        # The third term is to the second as the second to the first: a tenth of the difference.
        assert second[1] / second[0] == pytest.approx(10.0, rel=2.0 * abs(second[1]) / 10.0)
    assert lacks[0] < 1e-3


# --- laws ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("tube", [True, False])
def test_static_load_equals_the_foot_forces(tube):
    """Resultant and moment about the block's centre of mass."""
    body = suspended(tube)
    load = LOAD.real
    force = body.response(load.astype(complex), 0.0).foot_force
    place = body.foot_position - [0.0, 0.0, MACHINE.suspension.height_m]
    scale = np.max(np.abs(force))
    np.testing.assert_allclose(force.sum(axis=0), load[:3], atol=ROUNDING * scale)
    moment = np.cross(place, force).sum(axis=0)
    np.testing.assert_allclose(moment, load[3:], atol=ROUNDING * scale)


@pytest.mark.parametrize("frequency", [3.0, 7.0, 49.2, 300.0])
def test_reciprocity_of_the_block(frequency):
    body = suspended()
    mobility = np.array([body.response(unit, frequency).block_velocity for unit in np.eye(6)])
    np.testing.assert_allclose(mobility, mobility.T, atol=ROUNDING * np.max(np.abs(mobility)))


@pytest.mark.parametrize("frequency", [3.0, 24.0, 49.2])
def test_power_goes_into_the_loss_factors(frequency):
    """½ Re(F* v) = ω/2 Σ η δ* k δ over springs, feet and tube."""
    body = suspended()
    response = body.response(LOAD, frequency)
    put_in = 0.5 * np.real(np.vdot(LOAD, response.block_velocity))
    omega = 2.0 * np.pi * frequency
    motion = np.concatenate([response.velocity, response.block_velocity]) / (1j * omega)
    lost = 0.0
    for bushing, moved in zip(
        body.isolation.bushings, body.isolation.bushing_motion @ motion, strict=True
    ):
        stiffness = bushing.loss_factor_ratio * bushing.in_frame(bushing.stiffness)
        lost += 0.5 * omega * np.real(np.vdot(moved, stiffness @ moved))
    assert put_in > 0.0
    # Put in is a small difference of large in-phase parts: eps times a condition of 1e5 of them.
    size = 0.5 * np.linalg.norm(LOAD) * np.linalg.norm(response.block_velocity)
    assert put_in == pytest.approx(lost, abs=ROUNDING * size)


def test_tube_stiffens_the_suspension():
    """More stiffness lowers no natural frequency (Rayleigh); the tube holds the block a little."""
    with_tube, without = (suspended(tube).isolation.natural_modes()[0] for tube in (True, False))
    assert np.all(with_tube >= without * (1.0 - ROUNDING))
    assert np.max(with_tube / without) > 1.001


# --- in a study ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def results():
    return pipeline.run(load_study(STUDY), radiation=made_up_radiation)


@pytest.mark.long
def test_each_redesign_moves_on_its_own_springs(results):
    study = load_study(STUDY)
    machine = study.options["softer-springs"].machine
    softer = on_mounts(machine)
    assert softer.suspension == machine.suspension
    own = results.isel(speed=0).sel(option="softer-springs").sum("source")
    load = np.concatenate([own["force_order"].values[:, 1], own["moment_order"].values[:, 1]])
    expected = softer.response(load, 2950.0 / 60.0).foot_force
    found = own["foot_force_order"].sel(order=1).transpose("foot", "axis").values
    np.testing.assert_allclose(found, expected, atol=ROUNDING * np.max(np.abs(expected)))
    feet = results["foot_force_amplitude"].sel(order=1).max("foot")
    assert np.all(feet.sel(option="softer-springs") < feet.sel(option="none"))
    same = results["force_order"].sel(option=["none", "softer-springs"]).values
    np.testing.assert_array_equal(same[:, 0], same[:, 1])


def test_report_tells_the_motion_at_the_springs(results):
    """Against the displacement of the block's and the shell's corners, instant by instant."""
    own = results.isel(speed=0).sel(option="none").sum("source")
    inside = MACHINE.suspension
    period, largest = 60.0 / 2950.0, 0.0
    for time in np.linspace(0.0, period, 97):
        shift = {}
        for body, variable in (("block", "block_velocity_order"), ("shell", "velocity_order")):
            velocity = own[variable].transpose("order", "dof").values[1:]
            omega = 2.0 * np.pi * np.arange(1, len(velocity) + 1)[:, None] / period
            shift[body] = np.sum(velocity / (1j * omega) * np.exp(1j * omega * time), axis=0).real
        for x in (-0.04, 0.04):
            for y in (-0.04, 0.04):
                low = inside.springs_height_m
                of_block = shift["block"][:3] + np.cross(shift["block"][3:], [x, y, low])
                place = [x, y, low + inside.height_m]
                of_shell = shift["shell"][:3] + np.cross(shift["shell"][3:], place)
                largest = max(largest, float(np.linalg.norm(of_block - of_shell)))
    table = block_table(results)
    rows = {row[0]: row[1:] for row in table.rows}
    assert list(rows) == list(results["option"].values)
    # Three digits are printed; 97 instants miss the peak of order 1 by less than (π/97)²/2.
    assert float(rows["none"][0]) == pytest.approx(1e3 * largest, rel=6e-3)
    assert float(rows["lanchester"][0]) < float(rows["none"][0])


def test_report_names_both_bodies(results):
    table = modes_table(results)
    assert table.caption.endswith("machine as it is")
    assert len(table.rows) == 12
    assert table.rows[0][2].startswith("block")


def test_machine_on_its_mounts_alone_has_no_block_table(results):
    assert block_table(results.drop_vars("spring_displacement")) is None


@pytest.mark.parametrize(
    ("table", "change"),
    [("shell", "height_mm = 180.0"), ("overall_noise", "level_dba = 30.0")],
)
def test_redesign_of_what_all_options_share_is_refused(tmp_path, table, change):
    name, _, value = change.partition(" = ")
    text = f'extends = "{STUDY}"\n[options.other]\nkind = "redesign"\n'
    text += f"[options.other.change.{table}]\n"
    text += f'{name} = {{ value = {value}, source = "a test" }}\n'
    file = tmp_path / "study.toml"
    file.write_text(text)
    with pytest.raises(ParameterError, match=rf"options\.other\.change\.{table}: ") as caught:
        load_study(file)
    assert "\n" not in str(caught.value)
