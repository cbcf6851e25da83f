"""Inner sources in a study: balance of their loads, sums, draws, contraction, bad input."""

import dataclasses

import numpy as np
import pytest
import pyuff
from inside_study import INSIDE_STUDY, made_up_modes, operating_of, path_of, run_made_up
from support import ROOT, assert_refused, balancing, command_here

from vibroacoustics import levels
from vibroacoustics.constants import REFERENCE_PRESSURE_PA
from vibroacoustics.errors import ParameterError, SolverError
from vibroacoustics.loading import load_study
from vibroacoustics.mechanics.added import Added, RingForce
from vibroacoustics.mechanics.capabilities import OldhamRing
from vibroacoustics.parameters.inside import DRAWN, Doubt, MeasuredModes
from vibroacoustics.parameters.shell_structure import JOINTS
from vibroacoustics.pipeline.inner_draws import latin_hypercube
from vibroacoustics.pipeline.inner_keys import (
    KEY_COMPONENTS,
    KeyRuns,
    Noise,
    key_sources,
)
from vibroacoustics.pipeline.inner_levels import labelled_levels
from vibroacoustics.pipeline.inner_sound import (
    SourceSound,
    mode_pressures,
    pressure_per_load,
    rigid_pressures,
    source_sound,
    whole_octave_thirds,
)
from vibroacoustics.pipeline.inner_sources import InnerLoads, InnerSources, Lines
from vibroacoustics.radiation.scene import machine_body
from vibroacoustics.sources.joint_loads import (
    BEARING_HOUSING,
    FIXED_SCROLL,
    STATOR,
    key_torque_n_m,
)
from vibroacoustics.sources.oldham_keys.spectra import spectral_density
from vibroacoustics.transfer import RigidBodyOnMounts
from vibroacoustics.transfer.shell_modes import elastic_shell

TEXT = INSIDE_STUDY.read_text(encoding="utf-8")
INSIDE_TEXT = (ROOT / "data" / "machines" / "copeland_zp41k3e_inside.toml").read_text("utf-8")
SUMS = 1e-10
"""Relative rounding of sums of some hundred products, in different order."""


@pytest.fixture(scope="module")
def study():
    return load_study(INSIDE_STUDY)


@pytest.fixture(scope="module")
def results(study):
    return run_made_up(study)


@pytest.fixture(scope="module")
def sources(study):
    return InnerSources(study.inside.inside)


def loads_of(sources, study, option, revolutions=2):
    ring = study.machine.require(OldhamRing)
    return sources.loads(ring, balancing(study, option, 2900.0), operating_of(study, revolutions))


# --- balance of the loads ------------------------------------------------------------------------


def test_gas_pulls_at_the_two_joints_with_equal_and_opposite_forces(sources, study):
    load = loads_of(sources, study, "none").lines["gas"].load
    assert np.all(load[FIXED_SCROLL, :3] == -load[BEARING_HOUSING, :3])
    assert np.all(load[STATOR] == 0.0)
    assert np.min(np.abs(load[FIXED_SCROLL, :3, 1])) > 10.0


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("option", ["none", "damping"])
def test_moments_about_the_shaft_add_up_to_the_rotors_momentum(study, option, friction):
    """Gas, keys and stator together leave the machine -d/dt of the rotor's momentum: all else
    that turns does so steadily, and the ring slides through the shaft's axis.

    What is left is the swing of ring and scroll within the flexing of the contacts: a turn of at
    most their range of depth, on both keys of a pair, over the radius of the keys.
    """
    keys = study.inside.inside.keys.model_copy(
        update={"friction_ratio": friction, "clearance_m": 2e-6}
    )
    inside = study.inside.inside.model_copy(update={"keys": keys})
    loads = loads_of(InnerSources(inside), study, option)
    assert loads.facts["key_impacts_per_revolution"] == 0.0
    order = np.arange(1, 9)
    moment = sum(loads.lines[name].load[:, 3].sum(axis=0) for name in loads.lines)
    momentum = sum(loads.lines[name].roll_moment_n_m for name in loads.lines)
    depth = (loads.facts["key_force_peak_n"] / keys.contact_stiffness_n_per_m1p5) ** (2.0 / 3.0)
    turn = 2.0 * depth / keys.radius_m
    inertia = keys.scroll_inertia_kg_m2 + keys.ring_inertia_kg_m2
    # Order k of what rises and falls twice by `turn`, its variation being V, is V/(π k) at most.
    omega = 2.0 * np.pi * loads.frequency_hz[order]
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
    machine, keys = study.machine, study.inside.inside.keys
    stroke, operating = machine.kinematics.orbit_radius_m, operating_of(study)
    forces = KeyRuns(keys).forces(
        machine.oldham.mass_kg, stroke, operating, np.array([5.12]), np.zeros(1)
    )
    along_scroll = forces.friction_n[:2].sum(axis=0) * np.cos(forces.crank_angle)
    along_housing = forces.friction_n[2:].sum(axis=0) * np.sin(forces.crank_angle)
    torque = key_torque_n_m(forces, stroke).mean()
    friction = stroke * float(np.mean(along_scroll + along_housing))
    assert friction > 0.01
    assert torque == pytest.approx(friction, rel=1e-3)


def test_keys_push_the_machine_with_the_rings_inertia(sources, study):
    """-m a at order 1, whatever damps the ring against the housing, and nothing with a twin.

    The contacts flex by 1 µm of the stroke of 3.5 mm, friction along y turns it by as little.
    """
    omega = 2.0 * np.pi * 2900.0 / 60.0
    inertia = study.machine.oldham.mass_kg * study.machine.kinematics.orbit_radius_m * omega**2
    push = {}
    for option in ("none", "damping", "twin-oldham"):
        load = loads_of(sources, study, option).lines["keys"].load
        push[option] = load[:, 0, 1]
        assert np.all(load[FIXED_SCROLL] == 0.0)
        assert np.any(load[STATOR] != 0.0) == (option == "twin-oldham")
    for option in ("none", "damping"):
        assert push[option][BEARING_HOUSING] == pytest.approx(inertia, rel=2e-3), option
    assert push["twin-oldham"][BEARING_HOUSING] == push["none"][BEARING_HOUSING]
    assert abs(push["twin-oldham"].sum()) < 0.02 * inertia  # its keys rattle within 15 µm


def test_twin_is_the_ring_turned_by_half_a_turn(study):
    """Its noise too: what couples a force with the moment changes its sign."""
    keys, operating = KeyRuns(study.inside.inside.keys), operating_of(study, 4)
    added, free = balancing(study, "twin-oldham", 2900.0), np.zeros(1)
    both = key_sources(keys, study.machine.require(OldhamRing), added, free, operating)
    first, second = both.noise
    assert (first.joint, second.joint) == (BEARING_HOUSING, STATOR)
    half_turn = np.array([-1.0, -1.0, 1.0])
    turned = half_turn[:, None, None] * first.density * half_turn[None, :, None]
    # The ring's force over 256 angles and the twin's of one value are the same zero.
    assert second.density == pytest.approx(turned, rel=1e-12, abs=1e-12)
    assert np.abs(first.density[0, 2]).max() > 0.0
    sign = np.array([-1.0, -1.0, 1.0, 1.0])
    assert both.load[STATOR] == pytest.approx(sign[:, None] * both.load[BEARING_HOUSING], rel=1e-12)


def test_hanging_pendulum_lowers_the_speed_of_contact_loss(thesis_study):
    """5809 to 4308 rpm at rated load without friction, closed form (oldham_keys.csv).

    The moment is that of the gas at the derived orbit radius, so the stroke is too. 4308 holds for
    bobs at rest at the angle at which they settle; theirs moves by a per cent.
    """
    ring = dataclasses.replace(thesis_study.machine.require(OldhamRing), stroke_m=3.461e-3)
    keys = thesis_keys()
    moment = np.array([2959.0 * 3.461e-3 / 2.0])
    operating = operating_of(load_study(INSIDE_STUDY), 1)
    omega = 2.0 * np.pi * operating.speed_rpm / 60.0
    angle = 2.0 * np.pi * np.arange(256) / 256
    # test_literature: the ring with its pendulums pushes 81.8 N where the bare one pushes 45.26 N.
    bobs = (81.8 / 45.26 - 1.0) * ring.mass_kg * 3.461e-3 * omega**2 * np.cos(angle)
    lost = [
        key_sources(KeyRuns(keys), ring, Added(on_ring=hung), moment, operating).facts[
            "key_contact_lost_above_rpm"
        ]
        for hung in (None, RingForce(bobs))
    ]
    assert lost[0] == pytest.approx(5809.0, rel=1e-3)
    assert lost[1] == pytest.approx(4308.0, rel=0.01)


def thesis_keys():
    """Without friction and at 55 mm, as in data/validation/oldham_keys.csv."""
    keys = load_study(INSIDE_STUDY).inside.inside.keys
    return keys.model_copy(update={"friction_ratio": 0.0})


def test_lines_of_the_motor_and_orders_of_the_shaft_never_share_a_place(sources, study):
    """Even at 3000 rpm, where twice 50 Hz is the frequency of order 2: the phases are unrelated."""
    operating = dataclasses.replace(operating_of(study), speed_rpm=3000.0)
    loads = sources.loads(study.machine.require(OldhamRing), Added(), operating)
    orders = operating.maximum_order + 1
    assert loads.line_name[2] == "order 2"
    assert loads.line_name.index("2 x line") >= orders
    assert loads.frequency_hz[loads.line_name.index("2 x line")] == 100.0
    assert loads.frequency_hz[2] == 100.0
    for source, lines in loads.lines.items():
        filled = np.any(lines.load != 0.0, axis=(0, 1)) | (lines.roll_moment_n_m != 0.0)
        own = filled[orders:] if source != "motor" else filled[:orders]
        assert not np.any(own), source
        assert np.any(filled), source
    assert len(loads.line_name) == len(set(loads.line_name)) == loads.frequency_hz.size


# --- contraction ---------------------------------------------------------------------------------


def pressure_by_loops(results, study, loads):
    """Complex peaks at (receiver, line) of all sources, one mode, joint and load after another."""
    path, inside = path_of(study), study.inside.inside
    frequency = loads.frequency_hz
    vectors = mode_pressures(results, frequency)
    pressure = {}
    for source, lines in loads.lines.items():
        total = np.zeros((vectors.shape[0], frequency.size), dtype=complex)
        for mode, shape in enumerate(path.modes):
            force = np.zeros(frequency.size, dtype=complex)
            for joint in range(len(JOINTS)):
                for component in range(4):
                    share = path.joint_forces[mode, joint, component]
                    force += share * lines.load[joint, component]
            omega, own = 2.0 * np.pi * frequency, 2.0 * np.pi * shape.frequency_hz
            stiffness = own**2 * (1.0 + 1j * inside.shell.loss_factor_ratio)
            velocity = 1j * omega * force / (shape.modal_mass_kg * (stiffness - omega**2))
            total += vectors[:, mode] * velocity
        pressure[source] = total + roll(results, study.machine, lines.roll_moment_n_m, frequency)
    return pressure


def roll(results, machine, moment, frequency):
    """Sound of the machine's turn about z on its mounts, at four corners of a square."""
    arm, mounts = machine.mounts.pitch_m / np.sqrt(2.0), machine.mounts
    stiffness = 4.0 * mounts.lateral_stiffness_n_per_m * arm**2
    omega = 2.0 * np.pi * frequency
    lossy = stiffness * (1.0 + 1j * mounts.loss_factor_ratio * (frequency > 0.0))
    speed = 1j * omega * moment / (lossy - omega**2 * machine.housing.inertia_zz_kg_m2)
    return rigid_pressures(results, frequency)[:, 5] * speed


def test_levels_are_those_of_a_contraction_by_loops(results, sources, study):
    for option in ("none", "twin-oldham"):
        loads = loads_of(sources, study, option)
        pressure = pressure_by_loops(results, study, loads)
        moving = results["pressure_order"].sel(speed=2900.0, option=option).sum("source")
        rigid = np.zeros_like(pressure["gas"])
        rigid[:, : moving.sizes["order"]] = moving.transpose("receiver", "order").values
        pressure["moving_parts"] = rigid
        audible = loads.frequency_hz > 0.0
        weight = np.zeros(audible.size)
        weight[audible] = 10.0 ** (levels.WEIGHTING["A"](loads.frequency_hz[audible]) / 10.0)
        noise = noise_by_loops(results, study, loads)
        square = 0.5 * np.abs(sum(pressure.values())) ** 2 @ weight + noise
        found = results["level_all_sources"].sel(speed=2900.0, option=option).values
        assert found == pytest.approx(decibel(square), abs=10.0 * SUMS)
        for source, peaks in pressure.items():
            own = 0.5 * np.abs(peaks) ** 2 @ weight + (noise if source == "keys" else 0.0)
            level = results["source_level"].sel(speed=2900.0, option=option, sound_source=source)
            assert level.values == pytest.approx(decibel(own), abs=10.0 * SUMS), source


def noise_by_loops(results, study, loads):
    """A-weighted mean square at the receivers of the keys' noise."""
    path, inside, total = path_of(study), study.inside.inside, 0.0
    for part in loads.noise["keys"]:
        way = pressure_per_load(
            path,
            mode_pressures(results, part.frequency_hz),
            part.frequency_hz,
            inside.shell.loss_factor_ratio,
            inside.doubt.frequency_factor_ratio,
        )[:, part.joint]
        step = part.frequency_hz[1] - part.frequency_hz[0]
        for line in range(1, part.frequency_hz.size):
            weight = 10.0 ** (levels.WEIGHTING["A"](part.frequency_hz[line]) / 10.0)
            heard = way[:, list(KEY_COMPONENTS), line]
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
    silent = np.zeros((len(JOINTS), 4, 1), dtype=complex)
    loads = InnerLoads(
        ("order 0",),
        np.zeros(1),
        {"keys": Lines(silent, np.zeros(1, dtype=complex))},
        {"keys": [Noise(BEARING_HOUSING, frequency, density)]},
        {},
    )
    for way, expected in ((1.0j, 2.0), (-1.0j, 0.0)):
        heard = np.tile(np.array([1.0, way, 0.0])[None, :, None], (1, 1, frequency.size))
        lines = {"keys": np.zeros((1, 1), dtype=complex)}
        sound = source_sound(loads, lines, {"keys": [heard]}, whole_octave_thirds(400.0))
        assert sound.band.sum() == pytest.approx(expected, abs=1e-12)
        weight = 10.0 ** (levels.WEIGHTING["A"](tone) / 10.0)
        # The sidelines, 1 Hz off with a sixth of the power each, are weighted as they lie.
        assert sound.total[0] == pytest.approx(expected * weight, rel=1e-3, abs=1e-12)


def decibel(square):
    return 10.0 * np.log10(square / REFERENCE_PRESSURE_PA**2)


def test_shares_add_up_to_one_and_bands_hold_the_lines(results):
    assert results["source_share"].sum("sound_source").values == pytest.approx(1.0, abs=SUMS)
    assert np.abs(results["source_share"]).max() < 10.0  # parts that cancel stay small here
    assert np.all(results["band"] <= 1000.0)  # that of 1250 Hz is not filled up to 1200 Hz


def test_bands_are_whole():
    assert [band.nominal_hz for band in whole_octave_thirds(4000.0)][-1] == 3150.0
    assert [band.nominal_hz for band in whole_octave_thirds(4500.0)][-1] == 4000.0
    assert whole_octave_thirds(4000.0)[0].nominal_hz == 20.0


def test_pair_of_forces_on_one_joint_drives_nothing(study):
    """Gas forces with the fixed scroll held where the bearing housing is."""
    inside = study.inside.inside
    shell = inside.shell.model_copy(update={"fixed_scroll": inside.shell.bearing_housing})
    settings = study.inside.model_copy(
        update={"inside": inside.model_copy(update={"shell": shell})}
    )
    path = path_of(study.model_copy(update={"inside": settings}))
    pair = path.joint_forces[:, FIXED_SCROLL] - path.joint_forces[:, BEARING_HOUSING]
    assert np.all(pair == 0.0)
    apart = path_of(study).joint_forces
    assert np.abs(apart[:, FIXED_SCROLL] - apart[:, BEARING_HOUSING]).max() > 0.1


def test_rigid_machine_is_moved_by_momentum_alone(study, sources):
    """With modes that do not sound, gas and keys are silent and the rest is the rigid machine's.

    That modes have no share in the rigid motions is tested in test_shell_modes.
    """
    silent = run_made_up(study, gain=0.0)
    assert silent["source_level"].sel(sound_source=["gas", "keys"]).max() == levels.SILENCE_DB
    moving = silent["source_level"].sel(sound_source="moving_parts").values
    rigid = silent["level_modelled"].sel(weighting="A").values
    assert moving == pytest.approx(rigid, abs=10.0 * SUMS)
    loads = loads_of(sources, study, "none")
    assert np.all(loads.lines["gas"].roll_moment_n_m == 0.0)
    assert np.all(loads.lines["keys"].roll_moment_n_m == 0.0)


def test_modes_reach_the_highest_frequency_in_every_draw(study):
    """Where natural frequencies are lowered to 0.8, modes up to 1.25 times it come below it."""
    highest = study.radiation.maximum_frequency_hz
    lowest = min(inside.doubt.frequency_factor_ratio for inside in latin_hypercube(study.inside))
    every = elastic_shell(study.machine.shell, study.inside.inside.shell, highest / lowest).modes
    assert {mode.name for mode in every} <= {mode.name for mode in path_of(study).modes}


def test_body_on_mounts_turns_about_z_alone_under_a_moment_about_z(study):
    """So that its other motions need no transfer vector here."""
    machine = study.machine
    height = -machine.shell.centre_of_mass_height_m
    body = RigidBodyOnMounts(machine.housing, machine.mounts, height)
    moment = np.zeros((1, 6), dtype=complex)
    moment[0, 5] = 1.0
    velocity = body.velocity(moment, np.array([100.0]))[0]
    assert np.abs(velocity[:5]).max() < 1e-15 * abs(velocity[5]) / machine.mounts.pitch_m


def test_numbers_of_the_first_issue_do_not_change(results, study, tmp_path):
    """Every variable of a study without [inside] is there with it, bit for bit."""
    start, stop = TEXT.index("[inside]"), TEXT.index("[radiation]")
    bare = load_text(tmp_path, TEXT[:start] + TEXT[stop:])
    assert bare.inside is None
    without = run_made_up(bare)
    assert "source_level" in results
    assert "source_level" not in without
    for name in without.variables:
        np.testing.assert_array_equal(without[name].values, results[name].values, err_msg=name)


# --- draws ---------------------------------------------------------------------------------------


def test_hypercube_takes_every_stratum_of_every_range_once(study):
    settings = study.inside.model_copy(update={"random_samples": 12})
    drawn = latin_hypercube(settings)
    assert len(settings.doubts) == len(DRAWN)
    for doubt in settings.doubts:
        values = np.array([getattr(getattr(inside, doubt.table), doubt.field) for inside in drawn])
        low, high = doubt.lowest, doubt.highest
        wide = low > 0.0 and high / low > 3.0
        share = np.log(values / low) / np.log(high / low) if wide else (values - low) / (high - low)
        assert sorted(np.floor(12.0 * share).astype(int)) == list(range(12)), doubt


def test_hypercube_is_reproducible_and_follows_its_seed(study):
    one, same = latin_hypercube(study.inside), latin_hypercube(study.inside)
    other = latin_hypercube(study.inside.model_copy(update={"seed": 7}))
    assert one == same
    assert one != other


def test_hypercube_changes_nothing_but_what_is_in_doubt(study):
    base = study.inside.inside
    for inside in latin_hypercube(study.inside):
        back = inside
        for doubt in study.inside.doubts:
            table = getattr(back, doubt.table)
            value = getattr(getattr(base, doubt.table), doubt.field)
            back = back.model_copy(
                update={doubt.table: table.model_copy(update={doubt.field: value})}
            )
        assert inside != base
        assert back == base


def test_wide_ranges_are_drawn_over_their_logarithm(study):
    """Half of the draws lie below the geometric mean, not below the arithmetic one."""
    doubt = Doubt(table="keys", field="contact_stiffness_n_per_m1p5", lowest=1e9, highest=1e11)
    settings = study.inside.model_copy(update={"doubts": (doubt,), "random_samples": 10})
    stiffness = [inside.keys.contact_stiffness_n_per_m1p5 for inside in latin_hypercube(settings)]
    assert np.count_nonzero(np.array(stiffness) < 1e10) == 5


def heard_draws(study, squares):
    """Draws of one source with given A-weighted mean squares, the first one as assumed."""
    receivers, bands = len(study.receivers), whole_octave_thirds(1200.0)
    return bands, [
        {
            (2900.0, option): (
                SourceSound(
                    ("gas",),
                    np.full((1, receivers, len(bands)), square),
                    np.full((1, receivers), square),
                    np.full((1, receivers), square),
                ),
                {"figure": 1.0},
            )
            for option in study.options
        }
        for square in squares
    ]


def test_draws_above_the_overall_level_are_left_out_and_counted(study, results):
    published = study.machine.overall_noise.level_dba
    overall = REFERENCE_PRESSURE_PA**2 * 10.0 ** (published / 10.0)
    quiet, loud = overall * np.array([0.1, 0.2, 0.3, 0.4]), [1.01 * overall, 9.0 * overall]
    bands, heard = heard_draws(study, [0.5 * overall, *quiet, *loud])
    found = labelled_levels(study, results, heard, bands)
    level = found["source_level_quantile"]
    assert (level.attrs["draws"], level.attrs["draws_above_overall_level"]) == (6, 2)
    expected = np.quantile(decibel(quiet), [0.1, 0.5, 0.9])
    assert level.sel(option="none").values[:, 0, 0, 0] == pytest.approx(expected, abs=1e-9)
    # With the remainder every draw that is kept meets the overall level at its microphone.
    whole = found["level_whole_quantile"].sel(option="none", receiver="front_1m").values
    assert whole == pytest.approx(published, abs=1e-9)
    rest = np.quantile(decibel(overall - quiet), [0.1, 0.5, 0.9])
    assert found["inner_remainder_level"].values == pytest.approx(rest, abs=1e-9)


def test_too_few_quiet_draws_are_one_line(study, results):
    bands, heard = heard_draws(study, [1e-6, 1e-6, 1e-6, 1.0, 1.0])
    with pytest.raises(SolverError) as failure:
        labelled_levels(study, results, heard, bands)
    message = str(failure.value)
    assert "only 2 of 4 draws are below the overall level, 3 are needed" in message
    assert len(message.splitlines()) == 1


def test_same_study_gives_the_same_numbers(study, results):
    """Draws run side by side in threads; their order and numbers do not depend on that."""
    again = run_made_up(study)
    for name in ("level_all_sources_quantile", "source_level", "inner_figure"):
        np.testing.assert_array_equal(again[name].values, results[name].values)


# --- bad input -----------------------------------------------------------------------------------


def load_text(folder, text, inside=INSIDE_TEXT):
    """A study and its inside, in a folder."""
    (folder / "inside.toml").write_text(inside, encoding="utf-8")
    text = text.replace("../../data/machines/copeland_zp41k3e_inside.toml", "inside.toml")
    (folder / "study.toml").write_text(text.replace("../../data", str(ROOT / "data")))
    return load_study(folder / "study.toml")


def refused(folder, old, new, words, of_inside=False):
    text = INSIDE_TEXT if of_inside else TEXT
    assert text.count(old) == 1, old
    changed = text.replace(old, new)
    with pytest.raises(ParameterError) as refusal:
        load_text(folder, *((TEXT, changed) if of_inside else (changed,)))
    message = str(refusal.value)
    assert len(message.splitlines()) == 1
    for word in words:
        assert word in message, message


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("copeland_zp41k3e_inside.toml", "none.toml", ["none.toml", "no such file"]),
        ('file = "../../data/machines/copeland_zp41k3e_inside.toml"', "", ["inside.file"]),
        ("= [50.0]", "= [50.0, 60.0]", ["inside.line_frequency_hz", "2 values for 1 speeds"]),
        ("= [50.0]", "= [-50.0]", ["line_frequency_hz = -50 Hz", "1 to 1000 Hz"]),
        ("= [50.0]", "= [650.0]", ["maximum_frequency_hz = 1200 Hz", "line frequency is 1300 Hz"]),
        ("random_samples = 4", "random_samples = 3", ["inside.random_samples = 3", "from 4 to"]),
        ("random_samples = 4", "doubts = []", ["inside.doubts", "unknown key"]),
        ("random_samples = 4", "inside = {}", ["inside.inside", "unknown key"]),
        ("random_samples = 4", "draws = 4", ["inside.draws", "unknown key"]),
        (
            "[operation]",
            '[machine.override.kinematics]\norbit_radius_mm = { value = 6.75, source = "thesis" }\n'
            "[operation]",
            ["inside", "wraps orbit at 3.461 mm", "6.75 mm", "within 1 %"],
        ),
        (
            "[receivers.front_1m]",
            '[options.wide]\nkind = "redesign"\n[options.wide.change.kinematics]\n'
            'orbit_radius_mm = { value = 5.0, source = "test" }\n[receivers.front_1m]',
            ["options.wide.change", "wraps orbit at 3.461 mm", "5 mm"],
        ),
    ],
)
def test_bad_settings_are_refused(tmp_path, old, new, words):
    refused(tmp_path, old, new, words)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("value = 1.1558,", "value = 0.9,", ["inside.toml", "polytropic_index = 0.9"]),
        ("range = [1.03, 1.16]", "range = [0.9, 1.16]", ["gas.polytropic_index = 0.9", "above 1"]),
        ("at low speed\", range = [0.4, 0.9]", "at low speed\", range = [0.4, 1.5]",
         ["restitution_ratio = 1.5", "to 1"]),
        ("value = 15.0, source = \"assumed: on each", "value = 0.1, source = \"assumed: on each",
         ["clearance_um = 0.1", "outside its own range"]),
        ("[rotor]", "[rotors]", ["rotor", "missing"]),
        ("turns = {", "windings = {", ["wraps.turns", "missing"]),
    ],
)  # fmt: skip
def test_bad_values_of_the_inside_are_refused(tmp_path, old, new, words):
    refused(tmp_path, old, new, words, of_inside=True)


def test_inside_on_another_machine_is_refused_by_the_command(tmp_path):
    """One line, exit code 2."""
    study = tmp_path / "study.toml"
    other = (ROOT / "pipelines" / "mayekawa_wbhe.toml").read_text(encoding="utf-8")
    inside = TEXT[TEXT.index("[inside]") : TEXT.index("[radiation]")]
    text = other.replace("../data", str(ROOT / "data")) + inside
    study.write_text(text.replace("../../data", str(ROOT / "data")), encoding="utf-8")
    outcome = command_here("run", study, "--out", tmp_path / "out")
    assert_refused(outcome, "inside", "needs a scroll with an Oldham ring")


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
    radius = study.machine.shell.radius_m
    wall = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], -1).reshape(-1, 3)
    nodes = np.unique(np.concatenate([wall, body.vertices]).round(6), axis=0)
    numbers = np.arange(1, len(nodes) + 1)
    sets = [written_nodes(numbers, nodes)]
    sets += [written_mode(number, mode, numbers, nodes) for number, mode in enumerate(modes, 1)]
    file = tmp_path / "modes.uff"
    pyuff.UFF(str(file)).write_sets(sets, "overwrite")
    settings = study.inside.model_copy(
        update={"modes": MeasuredModes(file=str(file), file_unit_m=1.0)}
    )
    measured = path_of(study.model_copy(update={"inside": settings}))
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
