"""Sources in a study: balance of their loads, sums, samples, contraction, bad input."""

import dataclasses
from operator import attrgetter
from types import SimpleNamespace

import numpy as np
import pytest
import pyuff
from sources_study import (
    NO_DISCREPANCY,
    SOURCES_STUDY,
    all_lines,
    case_of,
    made_up_modes,
    nominal_run,
    on_parts,
    path_of,
    run_made_up,
    sources_run,
    with_tables,
)
from support import ROOT, assert_refused, command_here

from vibroacoustics import levels
from vibroacoustics.base.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.levels.agreement import log_weight_of_points, priors_of
from vibroacoustics.levels.by_source import filled_thirds, source_sound
from vibroacoustics.machine.frame import (
    BEARING_HOUSING,
    FIXED_SCROLL,
    LOWER_BEARING,
    ORBITING_SCROLL,
    STATOR,
)
from vibroacoustics.mechanics.added import RingForce
from vibroacoustics.mechanics.loads import Noise, total_torque_n_m
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.mechanics.received_sound import NoisePower
from vibroacoustics.radiation.pressure import wrench_pressure
from vibroacoustics.radiation.scene import machine_body
from vibroacoustics.radiation.transfer_vectors import pressure_per_velocity
from vibroacoustics.results.estimates import nominal
from vibroacoustics.sources.cases import cases_of, loaded_cases, loads_of
from vibroacoustics.sources.induction_motor.revolving_fields import (
    CapacitorMotor,
    on_supply,
    point_at_torque,
)
from vibroacoustics.sources.keys import OldhamKeyForces, spectral_density
from vibroacoustics.sources.oldham_keys.contact import contact_stiffness_n_per_m1p5
from vibroacoustics.sources.oldham_keys.rattle import steady_key_forces
from vibroacoustics.sources.part_loads import key_torque_n_m
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.samples import with_sample
from vibroacoustics.study.sampling import latin_hypercubes
from vibroacoustics.study.uncertainty import MeasuredModes, Range
from vibroacoustics.transfer import MachineOnMounts
from vibroacoustics.transfer.load_path import LoadPath
from vibroacoustics.transfer.observers import Observers
from vibroacoustics.transfer.path import pressure_per_load
from vibroacoustics.transfer.shell_modes.modes import elastic_shell
from vibroacoustics.uncertainty.prior_ensemble import MOST_ROUNDS

TEXT = SOURCES_STUDY.read_text(encoding="utf-8")
MACHINE_TEXT = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text("utf-8")
SUMS = 1e-10
"""Relative rounding of sums of some hundred products, in different order."""


@pytest.fixture(scope="module")
def study():
    return load_study(SOURCES_STUDY)


@pytest.fixture(scope="module")
def results():
    """With the nominal values alone."""
    return nominal_run()


@pytest.fixture(scope="module")
def sampled():
    return sources_run()


def loads_with(study, option):
    return loads_of(study, case_of(study, option))


def lines_with(study, option):
    case = case_of(study, option)
    return all_lines(case, loads_of(study, case))


HOUSING_JOINT, SCROLL_JOINT, STATOR_JOINT = range(3)


def to_joints(loads, count):
    """Loads on the joints of a shell without a frame, one part after another."""
    joints = np.zeros((3, 4, count), dtype=complex)
    for part, joint in (
        (FIXED_SCROLL, SCROLL_JOINT),
        (BEARING_HOUSING, HOUSING_JOINT),
        (ORBITING_SCROLL, HOUSING_JOINT),
        (LOWER_BEARING, STATOR_JOINT),
        (STATOR, STATOR_JOINT),
    ):
        if part in loads:
            joints[joint, :3] += loads[part][:3]
            if part != ORBITING_SCROLL:  # what turns it presses the keys
                joints[joint, 3] += loads[part][5]
    return joints


@pytest.fixture
def pressed_by(monkeypatch):
    """Sets the gas moment on the scroll, over uniform crank angles."""

    def set_moment(moment_n_m):
        cycle = SimpleNamespace(self_rotation_moment_n_m=moment_n_m)
        monkeypatch.setattr("vibroacoustics.sources.keys.gas_cycle", lambda *_: cycle)

    return set_moment


# --- balance of the loads ------------------------------------------------------------------------


def test_gas_pulls_at_the_two_scrolls_with_equal_and_opposite_forces(study):
    load = loads_with(study, "none")["gas"].lines
    assert np.all(load[FIXED_SCROLL][:3] == -load[ORBITING_SCROLL][:3])
    assert set(load) == {FIXED_SCROLL, ORBITING_SCROLL}
    assert np.min(np.abs(load[FIXED_SCROLL][:3, 1])) > 10.0


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("option", ["none", "damping"])
def test_moments_about_the_shaft_add_up_to_the_rotors_momentum(study, option, friction):
    """Gas, keys and stator together leave the machine -d/dt of the rotor's momentum: all else
    that turns does so steadily, and the ring slides through the shaft's axis.

    What is left is the swing of ring and scroll within the flexing of the contacts: a turn of at
    most their range of depth, on both keys of a pair, over the radius of the keys.
    """
    study = with_tables(study, keys={"friction_ratio": friction, "clearance_m": 2e-6})
    keys, case = study.machine.keys, case_of(study, option)
    loads = loads_of(study, case)
    lines, figures = all_lines(case, loads), loads["keys"].figures
    assert figures["key_impacts_per_revolution"] == 0.0
    order = np.arange(1, 9)
    count = lines.frequency_hz.size
    moment = sum(to_joints(load, count)[:, 3].sum(axis=0) for load in lines.loads.values())
    momentum = sum(load[HOUSING][5] for load in lines.loads.values() if HOUSING in load)
    stiffness = contact_stiffness_n_per_m1p5(keys.contact_modulus_pa, keys.crown_radius_m)
    depth = (figures["key_force_peak_n"] / stiffness) ** (2.0 / 3.0)
    turn = 2.0 * depth / keys.radius_m
    inertia = keys.scroll_inertia_kg_m2 + keys.ring_inertia_kg_m2
    # Order k of what rises and falls twice by `turn`, its variation being V, is V/(π k) at most.
    omega = 2.0 * np.pi * lines.frequency_hz[order]
    allowed = inertia * omega**2 * 4.0 * turn / (np.pi * order)
    assert np.all(np.abs(moment[order] - momentum[order]) < allowed)
    # The ring's own share, which the shaft bears at twice the speed, is well above that.
    speed = omega[0] * study.machine.kinematics.orbit_radius_m
    assert 0.5 * study.machine.oldham.mass_kg * speed**2 > 3.0 * allowed[1]


def test_work_of_the_shaft_on_the_keys_is_that_of_their_friction(study):
    """Force along each slot times the speed of sliding, ω r cos θ and ω r sin θ.

    Ring and scroll stray from it by the flexing of the contacts, 1 µm of 3.5 mm at most; the loss
    in films and contacts is of second order of that.
    """
    machine = study.machine
    stroke, (speed,) = machine.kinematics.orbit_radius_m, study.operation.speed_rpm
    forces = steady_key_forces(
        machine.keys, machine.oldham.mass_kg, stroke, speed, np.array([5.12]), np.zeros(1), 2
    )
    along_scroll = forces.friction_n[:2].sum(axis=0) * np.cos(forces.crank_angle)
    along_housing = forces.friction_n[2:].sum(axis=0) * np.sin(forces.crank_angle)
    torque = key_torque_n_m(forces, stroke).mean()
    friction = stroke * float(np.mean(along_scroll + along_housing))
    assert friction > 0.01
    assert torque == pytest.approx(friction, rel=1e-3)


def test_keys_push_the_machine_with_the_rings_inertia(study):
    """-m a at order 1, whatever damps the ring against the housing, and nothing with a twin.

    The contacts flex by 1 µm of the stroke of 3.5 mm, friction along y turns it by as little.
    """
    omega = 2.0 * np.pi * 2900.0 / 60.0
    inertia = study.machine.oldham.mass_kg * study.machine.kinematics.orbit_radius_m * omega**2
    push = {}
    for option in ("none", "damping", "twin-oldham"):
        load = loads_with(study, option)["keys"].lines
        push[option] = {part: wrench[0, 1] for part, wrench in load.items()}
        lower = {LOWER_BEARING} if option == "twin-oldham" else set()
        assert set(load) == {BEARING_HOUSING, ORBITING_SCROLL} | lower
    for option in ("none", "damping"):
        assert sum(push[option].values()) == pytest.approx(inertia, rel=2e-3), option
    for part in (BEARING_HOUSING, ORBITING_SCROLL):
        assert push["twin-oldham"][part] == push["none"][part]
    # Its keys rattle within 15 µm.
    assert abs(sum(push["twin-oldham"].values())) < 0.02 * inertia


def test_twin_is_the_ring_turned_by_half_a_turn(study, pressed_by):
    """Its noise too: what couples a force with the moment changes its sign."""
    pressed_by(np.zeros(1))
    study = with_tables(study, keys={"oil_layer_m": 0.0})
    both = OldhamKeyForces(revolutions=4).loads(case_of(study, "twin-oldham"), {})
    first, second = both.noise
    # The ring's force over 256 angles and the twin's of one value are the same zero.
    assert second.density == pytest.approx(first.density, rel=1e-12, abs=1e-12)
    assert np.abs(first.density[0, 2]).max() > 0.0
    sign = np.array([-1.0, -1.0, 1.0])
    ways = [sum(part.loads.values())[[0, 1, 5]] for part in (first, second)]
    assert np.all(ways[1] == sign[:, None] * ways[0])
    load = {part: wrench[[0, 1, 5]] for part, wrench in both.lines.items()}
    upper = load[BEARING_HOUSING] + load[ORBITING_SCROLL]
    assert load[LOWER_BEARING] == pytest.approx(sign[:, None] * upper, rel=1e-12, abs=1e-9)


def test_hanging_pendulum_lowers_the_speed_of_contact_loss(study, pressed_by):
    """5809 to 4308 rpm at rated load without friction, closed form (oldham_keys.csv).

    The moment is that of the gas at the derived orbit radius, so the stroke is too. 4308 holds for
    bobs at rest at the angle at which they settle; theirs moves by a per cent.
    """
    study = with_tables(
        study, keys={"friction_ratio": 0.0}, kinematics={"orbit_radius_m": 3.461e-3}
    )
    case = case_of(study)
    pressed_by(np.array([2959.0 * 3.461e-3 / 2.0]))
    omega = 2.0 * np.pi * case.shaft_frequency_hz
    angle = 2.0 * np.pi * np.arange(256) / 256
    # test_literature: the ring with its pendulums pushes 81.8 N where the bare one pushes 45.26 N.
    mass = study.machine.oldham.mass_kg
    bobs = (81.8 / 45.26 - 1.0) * mass * 3.461e-3 * omega**2 * np.cos(angle)
    lost = [
        OldhamKeyForces(revolutions=1)
        .loads(dataclasses.replace(case, added=dataclasses.replace(case.added, on_ring=hung)), {})
        .figures["key_contact_lost_above_rpm"]
        for hung in (None, RingForce(bobs))
    ]
    assert lost[0] == pytest.approx(5809.0, rel=1e-3)
    assert lost[1] == pytest.approx(4308.0, rel=0.01)


def test_lines_of_the_motor_and_orders_of_the_shaft_never_share_a_place(study):
    """Even at 3000 rpm, where twice 50 Hz is the frequency of order 2: the phases are unrelated."""
    operation = study.operation.model_copy(update={"speed_rpm": (3000.0,)})
    case = case_of(study.model_copy(update={"operation": operation}))
    lines = all_lines(case, loads_of(study, case))
    orders = case.maximum_order + 1
    assert lines.names[2] == "order 2"
    twice = lines.names.index("motor: 2 x line")
    assert twice >= orders
    assert lines.frequency_hz[twice] == 100.0
    assert lines.frequency_hz[2] == 100.0
    for source in study.sources:
        filled = np.any([load.any(axis=0) for load in lines.loads[source].values()], axis=0)
        own = filled[orders:] if source != "motor" else filled[:orders]
        assert not np.any(own), source
        assert np.any(filled), source
    assert len(lines.names) == len(set(lines.names)) == lines.frequency_hz.size


# --- contraction ---------------------------------------------------------------------------------


def mode_pressures(results, frequency):
    vectors = results["pattern_transfer_vector"].rename(pattern="dof")
    return pressure_per_velocity(vectors)(frequency)


def gain_of(study):
    return 10.0 ** (study.machine.variation.mobility_change_db / 20.0)


def pressure_by_loops(results, study, lines):
    """Complex peaks at (receiver, line) of all sources, one mode, joint and load after another."""
    path, structure = path_of(study), study.machine.structure
    frequency = lines.frequency_hz
    vectors = gain_of(study) * mode_pressures(results, frequency)
    assert study.machine.variation.frequency_factor_ratio == 1.0
    pressure = {}
    for source in study.sources:
        load = to_joints(lines.loads[source], frequency.size)
        wrench = lines.loads[source].get(HOUSING, np.zeros((6, frequency.size)))
        assert np.all(wrench[:5] == 0.0)
        total = np.zeros((vectors.shape[0], frequency.size), dtype=complex)
        for mode, shape in enumerate(path.modes):
            force = np.zeros(frequency.size, dtype=complex)
            for joint in range(len(load)):
                for component in range(4):
                    share = path.joint_forces[mode, joint, component]
                    force += share * load[joint, component]
            omega, own = 2.0 * np.pi * frequency, 2.0 * np.pi * shape.frequency_hz
            stiffness = own**2 * (1.0 + 1j * structure.loss_factor_ratio)
            velocity = 1j * omega * force / (shape.modal_mass_kg * (stiffness - omega**2))
            total += vectors[:, mode] * velocity
        pressure[source] = total + roll(results, study.machine, wrench[5], frequency)
    return pressure


def roll(results, machine, moment, frequency):
    """Sound of the machine's turn about z on its mounts, at four corners of a square."""
    arm, mounts = machine.mounts.pitch_m / np.sqrt(2.0), machine.mounts
    stiffness = 4.0 * mounts.lateral_stiffness_n_per_m * arm**2
    omega = 2.0 * np.pi * frequency
    lossy = stiffness * (1.0 + 1j * mounts.loss_factor_ratio * (frequency > 0.0))
    speed = 1j * omega * moment / (lossy - omega**2 * machine.housing.inertia_zz_kg_m2)
    return pressure_per_velocity(results["transfer_vector"])(frequency)[:, 5] * speed


def test_levels_are_those_of_a_contraction_by_loops(results, study):
    for option in ("none", "twin-oldham"):
        case = case_of(study, option)
        loads = loads_of(study, case)
        lines = all_lines(case, loads)
        pressure = pressure_by_loops(results, study, lines)
        moving = wrench_pressure(results, "transfer_vector").sel(speed=2900.0, option=option)
        rigid = np.zeros_like(pressure["gas"])
        moving = moving.sum("source").transpose("receiver", "order").values
        rigid[:, : moving.shape[1]] = moving
        pressure["moving_parts"] = rigid
        audible = lines.frequency_hz > 0.0
        weight = np.zeros(audible.size)
        weight[audible] = 10.0 ** (levels.WEIGHTING["A"](lines.frequency_hz[audible]) / 10.0)
        noise = noise_by_loops(results, study, loads["keys"])
        square = 0.5 * np.abs(sum(pressure.values())) ** 2 @ weight + noise
        found = results["level_modelled"].sel(speed=2900.0, option=option, weighting="A").values
        assert found == pytest.approx(decibel(square), abs=10.0 * SUMS)
        for source, peaks in pressure.items():
            at = {"speed": 2900.0, "option": option, "sound_source": source}
            own = 0.5 * np.abs(peaks) ** 2 @ weight + (noise if source == "keys" else 0.0)
            assert results["source_level"].sel(at).values == pytest.approx(
                decibel(own), abs=10.0 * SUMS
            ), source
            named = results["pressure_line"].sel(at).sel(line=list(lines.names)).values
            assert named == pytest.approx(peaks, rel=SUMS, abs=SUMS * np.abs(peaks).max()), source


def noise_by_loops(results, study, keys):
    """A-weighted mean square at the receivers of the keys' noise."""
    path, machine, total = path_of(study), study.machine, 0.0
    for part in keys.noise:
        way = pressure_per_load(
            path,
            mode_pressures(results, part.frequency_hz),
            part.frequency_hz,
            machine.structure.loss_factor_ratio,
            machine.variation,
            path.forces_of_parts(),
        )
        step = part.frequency_hz[1] - part.frequency_hz[0]
        for line in range(1, part.frequency_hz.size):
            weight = 10.0 ** (levels.WEIGHTING["A"](part.frequency_hz[line]) / 10.0)
            heard = way[..., line] @ np.concatenate([*on_parts(part.loads).values()])
            power = [(h.conj() @ part.density[..., line] @ h).real for h in heard]
            total = total + weight * step * np.array(power)
    return total


def test_noise_keeps_the_phases_between_its_forces():
    """Force along y a quarter period behind that along x, on a way with j times its pressure.

    Both arrive in step: peaks of 1 + 1 Pa, a mean square of 2 Pa². Turned round they cancel. The
    tone falls on a line of the window, whose own sidelines hold the rest of the power.
    """
    rate, tone = 1000.0, 100.0
    phase = 2.0 * np.pi * tone * np.arange(4000) / rate
    forces = np.stack([np.cos(phase), np.sin(phase), np.zeros(4000)])
    frequency, density = spectral_density(forces, rate, 1000)
    on_housing = np.zeros((6, 3))
    on_housing[[0, 1, 5], [0, 1, 2]] = 1.0
    noise = Noise({BEARING_HOUSING: on_housing}, frequency, density)
    three = Observers(lambda at: np.zeros((3, 6, at.size)))
    silent = LoadPath(SimpleNamespace()).noise_power(
        three, Noise({BEARING_HOUSING: on_housing}, frequency, 0.0 * density)
    )
    np.testing.assert_array_equal(silent, np.zeros((3, frequency.size)))
    for way, expected in ((1.0j, 2.0), (-1.0j, 0.0)):
        per_load = np.zeros((1, 6, frequency.size), dtype=complex)
        per_load[0, :2] = np.array([1.0, way])[:, None]
        shell = SimpleNamespace(response=lambda *_, per_load=per_load: per_load)
        microphone = Observers(lambda _: np.zeros((1, 6, 1)), lambda _: np.zeros((1, 0, 1)))
        power = LoadPath(SimpleNamespace(), shell).noise_power(microphone, noise)
        sound = source_sound(
            np.zeros((1, 1, 1), dtype=complex),
            np.zeros(1),
            [NoisePower(0, frequency, power)],
            filled_thirds(400.0),
        )
        assert sound.band.sum() == pytest.approx(expected, abs=1e-12)
        weight = 10.0 ** (levels.WEIGHTING["A"](tone) / 10.0)
        # The sidelines, 1 Hz off with a sixth of the power each, are weighted as they lie.
        assert sound.total[0, 0] == pytest.approx(expected * weight, rel=1e-3, abs=1e-12)


def decibel(square):
    return 10.0 * np.log10(square / REFERENCE_PRESSURE_PA**2)


def test_shares_add_up_to_one_and_bands_hold_the_lines(sampled):
    for suffix in ("", "_nominal"):
        share = sampled[f"source_share{suffix}"]
        total = share.sum("sound_source") + sampled[f"unmodelled_share{suffix}"]
        assert total.values == pytest.approx(1.0, abs=SUMS)
        assert np.abs(share).max() < 10.0  # parts that cancel stay small here
    assert np.all(sampled["band"] <= 1000.0)  # that of 1250 Hz is not filled up to 1200 Hz


def test_bands_are_whole():
    assert [band.nominal_hz for band in filled_thirds(4000.0)][-1] == 3150.0
    assert [band.nominal_hz for band in filled_thirds(4500.0)][-1] == 4000.0
    assert filled_thirds(4000.0)[0].nominal_hz == 20.0


def test_pair_of_forces_on_one_joint_drives_nothing(study):
    """Gas forces with the fixed scroll held where the bearing housing is."""
    held = {"fixed_scroll": study.machine.structure.bearing_housing}
    path = path_of(with_tables(study, structure=held))
    pair = path.joint_forces[:, SCROLL_JOINT] - path.joint_forces[:, HOUSING_JOINT]
    assert np.all(pair == 0.0)
    apart = path_of(study).joint_forces
    assert np.abs(apart[:, SCROLL_JOINT] - apart[:, HOUSING_JOINT]).max() > 0.1


@pytest.fixture(scope="module")
def without(tmp_path_factory):
    """Results of the study without sources."""
    start, stop = TEXT.index("[sources.gas]"), TEXT.index("[radiation]")
    bare = load_text(tmp_path_factory.mktemp("bare"), TEXT[:start] + TEXT[stop:])
    assert bare.sources == {}
    return run_made_up(bare)


def test_rigid_machine_is_moved_by_momentum_alone(study, without):
    """With modes that do not sound, gas and keys are silent and the rest is the rigid machine's.

    That modes have no share in the rigid motions is tested in test_shell_modes.
    """
    silent = run_made_up(study, gain=0.0)
    assert silent["source_level"].sel(sound_source=["gas", "keys"]).max() == levels.SILENCE_DB
    moving = nominal(silent, "source_level").sel(sound_source="moving_parts").values
    rigid = without["level_modelled"].sel(weighting="A").values
    assert moving == pytest.approx(rigid, abs=10.0 * SUMS)
    lines = lines_with(study, "none")
    assert HOUSING not in lines.loads["gas"]
    assert HOUSING not in lines.loads["keys"]


def test_modes_reach_the_highest_frequency_in_every_sample(study):
    """Where natural frequencies are lowered to 0.8, modes up to 1.25 times it come below it."""
    highest = study.radiation.maximum_frequency_hz
    hypercube = next(latin_hypercubes(study.ranges, study.uncertainty))
    lowest = min(sample["variation", "frequency_factor_ratio"] for sample in hypercube)
    every = elastic_shell(study.machine.shell, study.machine.structure, highest / lowest).modes
    assert {mode.name for mode in every} <= {mode.name for mode in path_of(study).modes}


def test_body_on_mounts_turns_about_z_alone_under_a_moment_about_z(study):
    """So that its other motions need no transfer vector here."""
    machine = study.machine
    height = -machine.shell.centre_of_mass_height_m
    body = MachineOnMounts(machine.housing, machine.mounts, height)
    moment = np.zeros((1, 6), dtype=complex)
    moment[0, 5] = 1.0
    velocity = body.response(moment, np.array([100.0])).velocity[0]
    assert np.abs(velocity[:5]).max() < 1e-15 * abs(velocity[5]) / machine.mounts.pitch_m


def test_sources_do_not_change_the_moving_parts(results, without):
    """What a study without sources says of forces, motion and their sound, bit for bit."""
    heard = {"pressure_line", "order_level", "level_modelled", "level_total", "level_unmodelled"}
    heard |= {"source_level", "source_share", "source_band_level", "reported_figure"}
    heard |= {"change_1x", "change_modelled", "change_total", "criterion_value", "score", "rank"}
    heard |= {"order_change"}
    heard |= {"first_place_share", "noise_band_level", "unmodelled_band_level", "residual_level"}
    heard |= {"total_band_level", "unmodelled_share", "loudness", "sharpness"}
    heard |= {"increase_probability", "decrease_probability", "sources_band_level"}
    heard |= {"evidence_simulation", "evidence_inputs", "decisive_audibility", "tonal_adjustment"}
    heard |= {name for name in map(str, without.data_vars) if "tone_" in name}
    heard |= {"decisive_audibility", "tonal_adjustment", "order_change"}
    shown = ("run_up_", "polar_", "deflection", "section_force")
    heard |= {name for name in map(str, without.data_vars) if name.startswith(shown)}
    heard |= {name for name, array in without.data_vars.items() if "path_speed" in array.dims}
    same = set(without.data_vars) - heard
    places = (one["rank_acceptability"].values for one in (without, results))
    np.testing.assert_allclose(*places, rtol=SUMS)
    same -= {"rank_acceptability"}  # a sum over the weights of the samples
    assert {"force", "force_order", "velocity_order", "foot_force_order", "mode_shape"} <= same
    for name in same:
        np.testing.assert_array_equal(without[name].values, results[name].values, err_msg=name)
    for name in ("source_level", "source_band_level", "pressure_line"):
        moving = without[name].sel(sound_source="moving_parts")
        among = results[name].sel(sound_source="moving_parts")
        if "line" in moving.dims:
            among = among.sel(line=moving["line"])
        np.testing.assert_allclose(among.values, moving.values, rtol=SUMS, err_msg=name)
    figures = without["reported_figure"]
    among = results["reported_figure"].sel(figure=figures["figure"])
    np.testing.assert_array_equal(among.values, figures.values)


# --- samples -------------------------------------------------------------------------------------


def test_hypercube_takes_every_stratum_of_every_range_once(study):
    settings = study.uncertainty.model_copy(update={"random_samples": 12})
    sampled = next(latin_hypercubes(study.ranges, settings))
    for limits in study.ranges:
        values = np.array([sample[limits.table, limits.field] for sample in sampled])
        low, high = limits.lowest, limits.highest
        wide = low > 0.0 and high / low > 3.0
        share = np.log(values / low) / np.log(high / low) if wide else (values - low) / (high - low)
        if limits.integer:  # tests/units/uncertainty
            continue
        assert sorted(np.floor(12.0 * share).astype(int)) == list(range(12)), limits


def test_hypercube_is_reproducible_and_follows_its_seed(study):
    one, same = (next(latin_hypercubes(study.ranges, study.uncertainty)) for _ in range(2))
    other = next(latin_hypercubes(study.ranges, study.uncertainty.model_copy(update={"seed": 7})))
    assert one == same
    assert one != other


def test_sample_changes_nothing_but_what_is_not_known(study):
    base = study.machine
    for sample in next(latin_hypercubes(study.ranges, study.uncertainty)):
        sampled = with_sample(base, base, sample)
        for (table, field), value in sample.items():
            assert attrgetter(f"{table}.{field}")(sampled) == value
        given = {pair: attrgetter(".".join(pair))(base) for pair in sample}
        assert sampled != base
        back = with_sample(sampled, sampled, given)
        for name in type(base).model_fields:
            if name != "housing":  # whose inertia across follows along, to rounding
                assert getattr(back, name) == getattr(base, name), name


def test_sample_leaves_what_an_option_has_changed(study):
    """A redesign that sets the clearance keeps it in every sample."""
    changed = with_tables(study, keys={"clearance_m": 1e-6}).machine
    sample = {("keys", "clearance_m"): 2e-5, ("keys", "friction_ratio"): 0.03}
    sampled = with_sample(changed, study.machine, sample)
    assert (sampled.keys.clearance_m, sampled.keys.friction_ratio) == (1e-6, 0.03)


def test_wide_ranges_are_sampled_over_their_logarithm(study):
    """Half of the samples lie below the geometric mean, not below the arithmetic one."""
    name = "contact_stiffness_n_per_m1p5"
    limits = Range(table="keys", field=name, lowest=1e9, highest=1e11)
    settings = study.uncertainty.model_copy(update={"random_samples": 10})
    stiffness = [sample["keys", name] for sample in next(latin_hypercubes((limits,), settings))]
    assert np.count_nonzero(np.array(stiffness) < 1e10) == 5


def run_with_samples(study, count=6, published_dba=56.0):
    """Results with samples that differ in the mobility of the shell alone, without discrepancy."""
    mobility = Range(table="variation", field="mobility_change_db", lowest=-10.0, highest=40.0)
    few = study.replace(NO_DISCREPANCY | {"uncertainty.random_samples": count})
    noise = {"spectral_share": None, "level_dba": published_dba}
    return run_made_up(with_tables(few.model_copy(update={"ranges": (mobility,)}),
                                   overall_noise=noise))  # fmt: skip


def test_samples_count_by_how_well_they_agree_with_the_published_level(study):
    published = 60.0
    found = run_with_samples(study, published_dba=published)
    level = found["prior_sample_level"].values
    flat, _ = priors_of(study.machine.remainder)
    deviation_db = study.machine.overall_noise.deviation_db
    expected = np.exp(log_weight_of_points((level - published)[None], deviation_db, flat))
    assert found["prior_sample_weight"].values[0] == pytest.approx(expected / expected.max())
    assert level.max() > published + 15.0
    assert expected[level > published + 15.0].max() < 1e-6 * expected.max()
    at = {"option": "none", "receiver": "front_1m", "speed": 2900.0}
    modelled = found["level_modelled_by_sample"].sel(at).values
    assert modelled.max() < published + 10.0
    # Unmodelled noise as sampled completes the total of each sample.
    whole = 10.0 ** (found["level_total_by_sample"].sel(at).values / 10.0)
    rest = 10.0 ** (found["level_unmodelled_by_sample"].values / 10.0)
    assert whole == pytest.approx(10.0 ** (modelled / 10.0) + rest)
    assert found["sample_weight"].sum("sample").values == pytest.approx([1.0, 1.0])


def test_a_model_that_is_much_too_loud_is_in_conflict_with_the_level(study):
    found = run_with_samples(study, count=4, published_dba=0.0)
    assert found["prior_sample_level"].min() > 20.0
    assert found["datum_tail"].sel(datum="level") < 1e-12
    assert found["conflict_tail"] == 0.0


def test_samples_without_solution_give_no_intervals(study, monkeypatch):
    revolution, given = type(study.machine).revolution, study.machine.orbiting_scroll.mass_kg

    def of_sample(machine, speed_rpm, samples):
        if machine.orbiting_scroll.mass_kg != given:
            raise SolverError("it does not turn")
        return revolution(machine, speed_rpm, samples)

    monkeypatch.setattr(type(study.machine), "revolution", of_sample)
    mass = tuple(one for one in study.ranges if one.name == "orbiting_scroll.mass_kg")
    with pytest.warns(UserWarning, match="have no solution.*it does not turn"):
        found = run_made_up(study.model_copy(update={"ranges": mass}))
    assert "sample_weight" not in found
    assert found.sizes["prior_sample"] == study.uncertainty.random_samples * MOST_ROUNDS
    assert np.isfinite(found["level_total"].values).all()
    assert not [name for name in found.data_vars if str(name).endswith("_nominal")]


@pytest.mark.long
def test_same_study_gives_the_same_numbers(study, sampled):
    """Samples run side by side in threads; their order and numbers do not depend on that."""
    again = run_made_up(study)
    for name in ("level_modelled_by_sample", "source_level", "reported_figure", "sampled_value"):
        np.testing.assert_array_equal(again[name].values, sampled[name].values)


# --- bad input -----------------------------------------------------------------------------------


def load_text(folder, text, machine=MACHINE_TEXT):
    """A study and its machine, in a folder."""
    (folder / "machine.toml").write_text(machine, encoding="utf-8")
    text = text.replace("../../data/machines/copeland_zp41k3e.toml", "machine.toml")
    (folder / "study.toml").write_text(text.replace("../../data", str(ROOT / "data")))
    return load_study(folder / "study.toml")


def refused(folder, old, new, words, of_machine=False):
    text = MACHINE_TEXT if of_machine else TEXT
    assert text.count(old) == 1, old
    changed = text.replace(old, new)
    with pytest.raises(ParameterError) as refusal:
        load_text(folder, *((TEXT, changed) if of_machine else (changed,)))
    lines = str(refusal.value).splitlines()
    assert any(all(word in line for word in words) for line in lines), lines


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("= [50.0]", "= [50.0, 60.0]", ["operation", "supply_frequency_hz: 2 values for 1 speeds"]),
        ("= [50.0]", "= [-50.0]", ["supply_frequency_hz = -50 Hz", "1 to 1000 Hz"]),
        ("= [50.0]", "= [650.0]", ["maximum_frequency_hz = 1200 Hz", "frequency is 1300 Hz"]),
        ("random_samples = 4", "random_samples = 3", ["uncertainty.random_samples = 3", "from 4"]),
        ("random_samples = 4", "doubts = []", ["uncertainty.doubts", "unknown key"]),
        ("random_samples = 4", "samples = 4", ["uncertainty.samples", "unknown key"]),
        ("[operation]", "[ranges]\n[operation]", ["ranges", "unknown key"]),
        ("revolutions = 2", "revolutions = 0", ["sources.keys.revolutions = 0", "from 1 to"]),
        ("revolutions = 2", "turns = 2", ["sources.keys.turns", "unknown key"]),
        ('"scroll-gas"', '"gas"', ["sources.gas", "kind = gas", "scroll-gas"]),
        ("[sources.motor]", "[sources.moving_parts]", ["sources.moving_parts", "always there"]),
        (
            "[operation]",
            '[machine.override.kinematics]\norbit_radius_mm = { value = 6.75, source = "thesis" }\n'
            "[operation]",
            ["sources.gas", "thickness_mm = 3.461 mm", "6.75 mm", "within 1 %"],
        ),
        (
            "[receivers.front_1m]",
            '[options.wide]\nkind = "redesign"\n[options.wide.change.kinematics]\n'
            'orbit_radius_mm = { value = 5.0, source = "test" }\n[receivers.front_1m]',
            ["options.wide.change", "thickness_mm = 3.461 mm", "5 mm"],
        ),
    ],
)
def test_bad_settings_are_refused(tmp_path, old, new, words):
    refused(tmp_path, old, new, words)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("value = 1.1558,", "value = 0.9,", ["machine.toml", "polytropic_index = 0.9"]),
        ("range = [1.03, 1.16]", "range = [0.9, 1.16]", ["gas.polytropic_index = 0.9", "above 1"]),
        ("at low speed\", range = [0.5, 0.9]", "at low speed\", range = [0.5, 1.5]",
         ["restitution_ratio = 1.5", "to 1"]),
        ("clearance_um = { value = 15.0", "clearance_um = { value = 0.1",
         ["clearance_um = 0.1", "outside its own range"]),
        ("[rotor]", "[rotors]", ["rotors", "unknown key"]),
        ("turns = {", "windings = {", ["wraps", "turns"]),
    ],
)  # fmt: skip
def test_bad_values_of_the_sources_are_refused(tmp_path, old, new, words):
    refused(tmp_path, old, new, words, of_machine=True)


def test_machine_without_a_table_cannot_have_its_source(tmp_path):
    start, stop = MACHINE_TEXT.index("[rotor]"), MACHINE_TEXT.index("[structure]")
    with pytest.raises(ParameterError, match=r"sources\.torque_ripple.*needs .* table rotor"):
        load_text(tmp_path, TEXT, MACHINE_TEXT[:start] + MACHINE_TEXT[stop:])


def test_supply_is_as_given(results):
    assert results["supply_frequency"].values.tolist() == [50.0]
    assert results["supply_frequency"].attrs["source"] == "given by the study"


def test_supply_that_is_not_given_follows_from_speed_and_slip(tmp_path):
    """It gives back the speed through the motor's torque curve; one for options and samples."""
    text = TEXT.replace("supply_frequency_hz = [50.0]", "").replace("[2900.0]", "[3500.0, 2900.0]")
    results = run_made_up(load_text(tmp_path, text.replace("stopping = true", "")))
    supply = results["supply_frequency"]
    assert supply.attrs["source"] == "derived from speed and slip"
    np.testing.assert_allclose(
        results["tone_frequency"].sel(line="motor: 2 x line"), 2.0 * supply, rtol=1e-12
    )
    without = load_text(tmp_path, TEXT.replace("supply_frequency_hz = [50.0]", ""))
    case, loads = reference_loads(without)
    assert case.supply_frequency_hz == pytest.approx(supply.sel(speed=2900.0).item(), rel=1e-9)
    before = [own for name, own in loads.items() if name not in ("motor", "torque_ripple")]
    mean = total_torque_n_m(before, case.maximum_order)[0].real
    motor = on_supply(case.machine.table(CapacitorMotor), case.supply_frequency_hz)
    slip = point_at_torque(motor, mean).slip
    assert 0.0 < slip < 0.1
    speed = 60.0 * case.supply_frequency_hz / motor.pole_pairs * (1.0 - slip)
    assert speed == pytest.approx(2900.0, rel=1e-9)


def reference_loads(study):
    """Case and loads without a balancer at the study's only speed."""
    cases, loads = loaded_cases(study, cases_of(study, lambda *_: None))
    assert len({case.supply_frequency_hz for case in cases.values()}) == 1
    return cases[2900.0, "none"], loads[2900.0, "none"]


def test_derived_supply_above_the_highest_frequency_is_refused(tmp_path):
    text = TEXT.replace("supply_frequency_hz = [50.0]", "")
    study = load_text(tmp_path, text)
    low = study.radiation.model_copy(update={"maximum_frequency_hz": 99.0})
    with pytest.raises(ParameterError, match=r"maximum_frequency_hz = 99 Hz: twice the supply"):
        reference_loads(study.model_copy(update={"radiation": low}))


def test_sources_on_another_machine_are_refused_by_the_command(tmp_path):
    """One line, exit code 2."""
    study = tmp_path / "study.toml"
    other = (ROOT / "pipelines" / "mayekawa_wbhe.toml").read_text(encoding="utf-8")
    sources = TEXT[TEXT.index("[sources.gas]") : TEXT.index("[radiation]")]
    text = other.replace("../data", str(ROOT / "data")) + sources
    study.write_text(text, encoding="utf-8")
    outcome = command_here("run", study, "--out", tmp_path / "out")
    assert_refused(outcome, "sources.gas", "needs an Oldham ring")


def test_made_up_modes_are_those_of_the_shell(study):
    """The helper of these tests hands over as many modes as there are."""
    assert made_up_modes(study).sizes["pattern"] == len(path_of(study).modes) > 4


def test_measured_modes_take_the_place_of_the_computed_ones(study, tmp_path):
    """Computed modes written to a universal file and read back drive and sound the same.

    Between nodes 10 mm apart a mode is interpolated linearly: with n = 2 to 4 around, an arc of
    10 mm of 83 mm radius sags by (4 · 0.12)²/8 = 3 % at most, with the sign of the motion.
    """
    path = path_of(study)
    modes = path.modes[:6]
    assert all(mode.around.order <= 4 for mode in modes)
    body = machine_body(study.machine.shell, study.radiation.body)
    angle, height = np.meshgrid(np.arange(0.0, 2 * np.pi, 0.12), np.arange(-0.18, 0.22, 0.01))
    radius = study.machine.shell.cylinder.radius_m
    wall = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], -1).reshape(-1, 3)
    nodes = np.unique(np.concatenate([wall, body.vertices]).round(6), axis=0)
    numbers = np.arange(1, len(nodes) + 1)
    sets = [written_nodes(numbers, nodes)]
    sets += [written_mode(number, mode, numbers, nodes) for number, mode in enumerate(modes, 1)]
    file = tmp_path / "modes.uff"
    pyuff.UFF(str(file)).write_sets(sets, "overwrite")
    settings = MeasuredModes(file=str(file), file_unit_m=1.0)
    measured = path_of(study.model_copy(update={"shell_modes": settings}))
    assert measured.natural_hz == pytest.approx(path.natural_hz[:6], rel=1e-5)
    assert measured.modal_mass_kg == pytest.approx(path.modal_mass_kg[:6], rel=1e-5)
    largest = np.abs(path.joint_forces[:6, :, :3]).max()
    assert measured.joint_forces[:, :, :3] == pytest.approx(
        path.joint_forces[:6, :, :3], abs=0.03 * largest
    )
    at = wall[::37] * (1.0 - 1e-9)
    for mode, read in zip(modes, measured.modes, strict=True):
        assert read.velocity(at) == pytest.approx(mode.velocity(at), abs=0.03)


def written_nodes(numbers, nodes):
    zeros = np.zeros(len(numbers), int)
    return pyuff.prepare_15(
        node_nums=numbers, def_cs=zeros, disp_cs=zeros, color=zeros + 1,
        x=nodes[:, 0], y=nodes[:, 1], z=nodes[:, 2],
    )  # fmt: skip


def written_mode(number, mode, numbers, nodes):
    moved = mode.velocity(nodes)
    return pyuff.prepare_55(
        model_type=1, id1="shell", analysis_type=2, data_ch=2, spec_data_type=8, data_type=2,
        n_data_per_node=3, load_case=1, mode_n=number, freq=mode.frequency_hz,
        modal_m=mode.modal_mass_kg, modal_damp_vis=0.0, modal_damp_his=0.0, node_nums=numbers,
        r1=moved[:, 0], r2=moved[:, 1], r3=moved[:, 2],
    )  # fmt: skip


# --- over speed ----------------------------------------------------------------------------------


def at_speeds_of(study, speeds, supplies):
    """The study at other speeds, with as many orders as the highest frequency holds."""
    change = {
        "speed_rpm": speeds,
        "supply_frequency_hz": supplies,
        "maximum_order": None,
        "stopping": False,
    }
    operation = study.operation.model_copy(update=change)
    return study.model_copy(update={"operation": operation})


@pytest.mark.long
def test_a_speed_alone_and_in_a_list_agree_with_all_sources(study):
    """Fewer orders fit below the highest frequency at 3500 rpm: 20, and 24 at 2900 rpm."""
    both = run_made_up(at_speeds_of(study, (3500.0, 2900.0), (60.0, 50.0)))
    alone = run_made_up(at_speeds_of(study, (2900.0,), (50.0,)))
    assert both.sizes["order"] == alone.sizes["order"] == 25
    for name in ("level_modelled", "level_total", "source_level", "level_total_by_sample"):
        same = both[name].sel(speed=2900.0)
        np.testing.assert_allclose(same, alone[name].sel(speed=2900.0), rtol=1e-9, err_msg=name)
    lines = both["pressure_line"].sel(speed=3500.0).isel(line=slice(21, 25))
    assert not lines.values.any()
    assert np.all(np.isnan(both["tone_frequency"].sel(speed=3500.0)[21:25]))
