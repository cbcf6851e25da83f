"""Rolling piston: volumes, torque, momentum, energy, vane and roller."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError, SolverError
from vibroacoustics.mechanics.rolling_piston import RollingPiston
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.mechanics.torque_control import TorqueControl
from vibroacoustics.mechanisms.rolling_piston.contact import contact_turn, first_contact
from vibroacoustics.mechanisms.rolling_piston.cycle import (
    RollingPistonCycle,
    bearing_forces_n,
    steady_cycle,
)
from vibroacoustics.mechanisms.rolling_piston.gas import gas_of
from vibroacoustics.mechanisms.rolling_piston.geometry import (
    compression_volume,
    displaced_m3,
    gas_force,
    suction_volume,
    vane_extension,
)
from vibroacoustics.mechanisms.rolling_piston.machine import RollingPistonMachine
from vibroacoustics.mechanisms.rolling_piston.revolution import friction_w, housing_wrenches
from vibroacoustics.mechanisms.rolling_piston.roller import (
    eccentric_drag_n_m_s,
    face_drag_n_m_s,
    journal_drag_n_m_s,
    roller_inertia_kg_m2,
)
from vibroacoustics.mechanisms.rolling_piston.vane import (
    jump_speed_rad_per_s,
    pressing_force_n,
    vane_flight,
)
from vibroacoustics.sources.cases import added_by
from vibroacoustics.transfer.machine import on_mounts

FILE = ROOT / "data" / "machines" / "rolling_piston.toml"
SAMPLES = 720
ANGLES = np.linspace(0.0, 2.0 * np.pi, 41)


@cache
def single() -> RollingPistonMachine:
    machine = va.load_machine(FILE)
    assert isinstance(machine, RollingPistonMachine)
    return machine


def changed(table: str, **values: object) -> RollingPistonMachine:
    machine = single()
    return machine.model_copy(update={table: getattr(machine, table).model_copy(update=values)})


@cache
def twin() -> RollingPistonMachine:
    return changed("cylinder", number=2, height_m=0.012, spacing_m=0.02)


@cache
def cycle_of(twin_cylinder: bool, speed_rpm: float = 3000.0) -> RollingPistonCycle:
    return steady_cycle(twin() if twin_cylinder else single(), speed_rpm, SAMPLES)


def outline_m(direction: float, contact: float) -> float:
    """Distance of the roller's surface from the shaft's axis in a direction."""
    cylinder = single().cylinder
    turned, e = direction - contact, cylinder.eccentricity_m
    root = np.sqrt(cylinder.roller_radius_m**2 - (e * np.sin(turned)) ** 2)
    return float(e * np.cos(turned) + root)


def area_m2(contact: float) -> float:
    """Area between bore and roller from the vane to the contact, by quadrature."""
    bore = single().cylinder.bore_radius_m
    value, _ = quad(lambda to: 0.5 * (bore**2 - outline_m(to, contact) ** 2), 0.0, contact,
                    epsabs=0.0, epsrel=1e-12, limit=200)  # fmt: skip
    return float(value)


def test_volumes_equal_the_quadrature_of_the_geometry() -> None:
    cylinder = single().cylinder
    x = np.array([cylinder.bore_radius_m - outline_m(0.0, angle) for angle in ANGLES])
    area = np.array([area_m2(angle) for angle in ANGLES])
    vane = 0.5 * cylinder.vane_thickness_m * x
    expected = cylinder.height_m * (area - vane)
    scale = displaced_m3(cylinder)
    assert vane_extension(cylinder, ANGLES)[0] == pytest.approx(x, abs=1e-12 * scale ** (1 / 3))
    assert np.max(np.abs(suction_volume(cylinder, ANGLES)[0] - expected)) < 1e-9 * scale
    mirrored = compression_volume(cylinder, 2.0 * np.pi - ANGLES)[0]
    assert np.max(np.abs(mirrored - expected)) < 1e-9 * scale
    assert suction_volume(cylinder, np.array([2.0 * np.pi]))[0, 0] == pytest.approx(scale, 1e-12)


def test_printed_volume_of_pdsim_is_no_volume() -> None:
    """Erratum: (a-1)² for (1/a-1)² in the last root."""
    cylinder, angle = single().cylinder, 0.3
    a = cylinder.roller_radius_m / cylinder.bore_radius_m
    right, printed = (np.sqrt(1.0 - (factor * np.sin(angle)) ** 2) for factor in (1 / a - 1, a - 1))
    error = 0.5 * cylinder.height_m * cylinder.bore_radius_m**2 * a * (1.0 - a) * np.sin(angle)
    volume = suction_volume(cylinder, np.array([angle]))[0, 0]
    assert -error * (printed - right) / volume == pytest.approx(-0.221, abs=1e-3)


@pytest.mark.parametrize(
    ("function", "row"),
    [(vane_extension, 0), (vane_extension, 1), (suction_volume, 0), (compression_volume, 0)],
)
def test_derivatives(function, row: int) -> None:
    """Central differences: error h²/6 of the third derivative, rounding eps/h of the value."""
    cylinder, h = single().cylinder, 1e-4
    angle = np.linspace(0.1, 6.1, 25)
    difference = (function(cylinder, angle + h)[row] - function(cylinder, angle - h)[row]) / (2 * h)
    exact = function(cylinder, angle)[row + 1]
    assert difference == pytest.approx(exact, abs=1e-7 * np.max(np.abs(exact)))


def test_order_1_of_the_vane_is_e_omega_squared_to_first_order() -> None:
    """The relative error is of second order in e/R_c: a quarter of it at half the ratio."""
    errors = []
    for ratio in (0.2, 0.1, 0.05):
        e = 0.027 * ratio
        cylinder = single().cylinder.model_copy(update={"eccentricity_m": e})
        acceleration = vane_extension(cylinder, uniform_crank_angle(256))[2]
        order_1 = 2.0 * np.fft.rfft(acceleration)[1] / 256
        assert abs(order_1.imag) < 1e-12 * e
        errors.append(abs(order_1.real / e - 1.0))
    assert errors[0] < 0.2**2
    assert errors[1] < errors[0] / 3.9 + 1e-13
    assert errors[2] < errors[1] / 3.9 + 1e-13


def test_force_of_the_gas_is_the_pressure_over_the_arc() -> None:
    cylinder, contact = single().cylinder, 2.2
    e, radius = cylinder.eccentricity_m, cylinder.roller_radius_m
    sine = e * np.sin(contact) / radius
    tip = -np.arcsin(sine)  # direction of the tip from the roller's centre
    expected = [
        -cylinder.height_m * radius * quad(part, contact, 2.0 * np.pi + tip)[0]
        for part in (np.cos, np.sin)
    ]
    force = gas_force(cylinder, np.array([contact]), np.array([1.0]))[:, 0]
    assert force == pytest.approx(expected, rel=1e-10)


def test_torque_of_gas_and_vane_is_their_virtual_work() -> None:
    """Also without the shell's pressure behind the vane, whose torque has no mean."""
    machine = single()
    cylinder, gas = machine.cylinder, machine.gas
    pressure = gas_of(machine, 3000.0, SAMPLES).compression_pa
    angle = uniform_crank_angle(SAMPLES)
    x, slope, _ = vane_extension(cylinder, angle)
    fx, fy = gas_force(cylinder, angle, pressure - gas.suction_pressure_pa)
    lever = cylinder.eccentricity_m * (np.cos(angle) * fy - np.sin(angle) * fx)
    torque = -lever - pressing_force_n(machine, pressure, x) * slope
    behind = cylinder.vane_thickness_m * cylinder.height_m * slope
    volumes = compression_volume(cylinder, angle)[1], suction_volume(cylinder, angle)[1], behind
    pressures = pressure, gas.suction_pressure_pa, gas.discharge_pressure_pa
    work = -sum(p * volume for p, volume in zip(pressures, volumes, strict=True))
    spring = machine.vane.spring_force_n - machine.vane.spring_stiffness_n_per_m * x
    assert torque == pytest.approx(work - spring * slope, abs=1e-12 * np.max(work))
    brief = -(pressure - gas.suction_pressure_pa) * volumes[0]
    assert np.mean(torque) == pytest.approx(np.mean(brief), rel=1e-9)
    missing = 2.0 * abs(np.fft.rfft(work - brief)[1]) / SAMPLES
    difference = gas.discharge_pressure_pa - gas.suction_pressure_pa
    area = cylinder.vane_thickness_m * cylinder.height_m
    assert missing == pytest.approx(difference * area * cylinder.eccentricity_m, rel=0.01)
    assert missing > 0.25 * np.mean(torque)


@pytest.mark.parametrize("twin_cylinder", [False, True])
def test_work_of_a_turn_is_that_of_gas_and_friction(twin_cylinder: bool) -> None:
    """The trapezoidal rule loses some 3e-10 of the roller's kinetic energy at 1440 angles."""
    machine = twin() if twin_cylinder else single()
    cycle = steady_cycle(machine, 3000.0, 2 * SAMPLES)
    cylinder, gas, angle = machine.cylinder, machine.gas, uniform_crank_angle(2 * SAMPLES)
    supplied = 2.0 * np.pi * np.mean(cycle.load_n_m)
    turn = 2.0 * np.pi * machine.cylinder.number
    slopes = compression_volume(cylinder, angle)[1], suction_volume(cylinder, angle)[1]
    of_gas = -turn * np.mean(
        cycle.gas.compression_pa * slopes[0] + gas.suction_pressure_pa * slopes[1]
    )
    friction = friction_w(machine, cycle) * cycle.rotation.duration_s
    assert supplied == pytest.approx(of_gas + friction, rel=1e-9)
    assert supplied == pytest.approx(2.0 * np.pi * np.mean(cycle.rotation.motor_torque_n_m), 1e-9)


def test_odd_orders_of_the_twins_torque_vanish() -> None:
    cycle, alone = cycle_of(True), cycle_of(False)
    spectrum = 2.0 * np.abs(np.fft.rfft(cycle.load_n_m)) / SAMPLES
    assert np.max(spectrum[1:40:2]) < 1e-12 * np.mean(cycle.load_n_m)
    assert spectrum[2] > 0.1 * np.mean(cycle.load_n_m)
    first = 2.0 * np.abs(np.fft.rfft(alone.load_n_m)[1]) / SAMPLES
    assert first > np.mean(alone.load_n_m)


def test_couple_of_the_twins_rollers_is_balanced_by_the_counterweights() -> None:
    machine, cycle = twin(), cycle_of(True)
    wrenches = housing_wrenches(machine, cycle)
    rollers = np.hypot(*wrenches["roller"].moment_n_m[:2])
    turning = [wrenches[name] for name in wrenches if name not in ("rotor", "vane")]
    unbalanced = np.sum([each.moment_n_m[:2] for each in turning], axis=0)
    expected = machine.roller.mass_kg * machine.cylinder.eccentricity_m * 0.02
    assert np.mean(rollers) == pytest.approx(expected * (2 * np.pi * 50) ** 2, rel=0.02)
    assert np.max(np.hypot(*unbalanced)) < 1e-6 * np.max(rollers)


def on_housing(machine: RollingPistonMachine, cycle: RollingPistonCycle) -> tuple:
    """Force across the shaft and moment about it on the housing, contact by contact."""
    cylinder, gas, vane = machine.cylinder, machine.gas, machine.vane
    angle, bore = uniform_crank_angle(SAMPLES), cylinder.bore_radius_m
    force = bearing_forces_n(machine, cycle).sum(axis=0)
    roll = journal_drag_n_m_s(machine) * cycle.rotation.speed_rad_per_s
    roll = roll - cycle.rotation.motor_torque_n_m
    for number, contact in enumerate(cycle.contacts):
        p_c, p_s = cycle.gas.compression_pa, gas.suction_pressure_pa
        x = contact.extension[0]
        wall = cylinder.height_m * bore
        on_bore = np.array([wall * (p_s - p_c) * np.sin(angle),
                            wall * (p_s - p_c) * (1.0 - np.cos(angle))])  # fmt: skip
        vane_area = cylinder.vane_thickness_m * cylinder.height_m
        spring = vane.spring_force_n - vane.spring_stiffness_n_per_m * x
        on_bore[0] += vane_area * (gas.discharge_pressure_pa - 0.5 * (p_c + p_s))
        on_bore[0] += spring - contact.slot_friction_n
        on_bore[1] -= contact.slot_n.sum(axis=0)
        rear = bore + vane.length_m - x
        moment = -contact.slot_n[0] * bore - contact.slot_n[1] * rear
        moment = moment + face_drag_n_m_s(machine) * contact.spin_rad_per_s
        force = force + cycle.over_shaft(on_bore, number)
        roll = roll + cycle.over_shaft(moment, number)
    return force, roll


@pytest.mark.parametrize("twin_cylinder", [False, True])
@pytest.mark.parametrize("speed_rpm", [1800.0, 5400.0])
def test_momentum_of_the_moving_parts(twin_cylinder: bool, speed_rpm: float) -> None:
    """Contact forces on the housing, of bearings, bore, slot, covers, stator: change of momentum.

    The paths are differentiated by Fourier series: (samples/2)² of rounding, 3e-11 of the roll.
    """
    machine, cycle = twin() if twin_cylinder else single(), cycle_of(twin_cylinder, speed_rpm)
    force, roll = on_housing(machine, cycle)
    wrenches = housing_wrenches(machine, cycle).values()
    of_momentum = np.sum([each.force_n[:2] for each in wrenches], axis=0)
    rolling = np.sum([each.moment_n_m[2] for each in wrenches], axis=0)
    largest = np.max(np.abs(bearing_forces_n(machine, cycle)))
    assert np.max(np.abs(force - of_momentum)) < 1e-9 * largest
    assert np.max(np.abs(roll - rolling)) < 1e-9 * np.max(np.abs(cycle.load_n_m))


def test_balanced_shaft_leaves_the_vane_alone() -> None:
    wrenches = housing_wrenches(single(), cycle_of(False))
    turning = [wrenches[name] for name in wrenches if name not in ("rotor", "vane")]
    force = np.sum([each.force_n for each in turning], axis=0)
    assert np.max(np.abs(force)) < 1e-6 * np.max(np.abs(wrenches["roller"].force_n))
    vane = np.max(np.abs(wrenches["vane"].force_n[0]))
    e_omega_2 = single().vane.mass_kg * 0.005 * (2.0 * np.pi * 50.0) ** 2
    assert vane == pytest.approx(e_omega_2, rel=0.5)


def test_roller_without_vane_friction_turns_by_its_films() -> None:
    """Steady: c_e (ω - ω_r) = c_f ω_r."""
    machine = changed("vane", tip_friction_ratio=0.0)
    omega = 2.0 * np.pi * 50.0
    gas = gas_of(machine, 3000.0, SAMPLES)
    rotation = va.constant_rotation(3000.0, SAMPLES)
    contact = contact_turn(machine, gas, rotation, first_contact(machine, gas, omega))
    eccentric, face = eccentric_drag_n_m_s(machine), face_drag_n_m_s(machine)
    assert contact.spin_rad_per_s == pytest.approx(omega * eccentric / (eccentric + face), rel=1e-9)


def test_roller_repeats_and_keeps_its_balance() -> None:
    contact, rotation = cycle_of(False).contacts[0], cycle_of(False).rotation
    machine, speed = single(), rotation.speed_rad_per_s
    film = eccentric_drag_n_m_s(machine) * (speed - contact.spin_rad_per_s)
    face = face_drag_n_m_s(machine) * contact.spin_rad_per_s
    tip = machine.cylinder.roller_radius_m * contact.tip_friction_n
    inertia = roller_inertia_kg_m2(machine)
    assert film - face - tip == pytest.approx(inertia * contact.spin_acceleration, abs=1e-9)
    assert abs(np.mean((film - face - tip) / speed)) < 1e-9 * np.mean(film / speed)
    assert 0.0 < np.mean(contact.spin_rad_per_s) < 0.5 * np.mean(speed)


def test_vane_leaves_above_its_jump_speed_and_not_below() -> None:
    """Equal pressures: the spring alone, k x against m x'' Ω²; momentum of the flight closes."""
    machine = single()
    angle = uniform_crank_angle(SAMPLES)
    extension = vane_extension(machine.cylinder, angle)
    spring = machine.vane.spring_force_n - machine.vane.spring_stiffness_n_per_m * extension[0]
    at_start = machine.vane.spring_force_n / (machine.vane.mass_kg * extension[2, 0])
    follows = extension[2] > 0.0
    bound = np.min(spring[follows] / (machine.vane.mass_kg * extension[2, follows]))
    assert bound <= at_start
    jump = float(np.sqrt(bound))
    assert jump_speed_rad_per_s(machine, spring, extension[2]) == pytest.approx(jump)
    below, landings = vane_flight(machine, spring, extension, 0.99 * jump)
    assert np.all(np.isnan(below))
    assert landings.impulse_n_s.size == 0
    speed = 1.15 * jump
    above, landings = vane_flight(machine, spring, extension, speed)
    flying = ~np.isnan(above)
    assert 0 < np.count_nonzero(flying) < SAMPLES
    assert np.all(landings.impulse_n_s > 0.0)
    kinematic = extension[2] * speed**2
    change = np.sum(np.where(flying, above, kinematic)) / np.sum(np.abs(kinematic))
    assert abs(change) < 2.0 * np.pi / SAMPLES  # the velocity of a periodic motion has no gain


def test_landing_vane_is_in_the_wrench_and_reported() -> None:
    """Hardly any pressure difference and a weak spring: the tip leaves at 3000 rpm."""
    machine = changed("vane", spring_force_n=12.0, spring_stiffness_n_per_m=0.0)
    gas = machine.gas.model_copy(update={"discharge_pressure_pa": 1.12e6})
    valve = machine.valve.model_copy(update={"port_diameter_m": 0.014, "lift_m": 0.0034})
    machine = machine.model_copy(update={"gas": gas, "valve": valve})
    revolution = machine.revolution(3600.0, 720)
    assert revolution.figures["vane_jump_speed_rpm"] < 3600.0
    assert revolution.figures["largest_landing_speed_m_per_s"] > 0.0
    cycle = steady_cycle(machine, 3600.0, 1440)
    histories = machine.require(RollingPiston).histories(3600.0, 1440)
    impulse = cycle.contacts[0].impacts.impulse_n_s
    lasted = -histories.landing_n * 2.0 * np.pi / 1440 / histories.speed_rad_per_s
    assert np.sum(lasted) == pytest.approx(np.sum(impulse), rel=1e-12)


def test_a_vane_without_spring_that_does_not_come_back_is_refused() -> None:
    angle = uniform_crank_angle(SAMPLES)
    extension = vane_extension(single().cylinder, angle)
    with pytest.raises(SolverError, match=r"does not come back .* raise vane.spring_force_n"):
        vane_flight(single(), np.full(SAMPLES, -1.0), extension, 300.0)


@pytest.mark.parametrize(
    ("table", "values", "text"),
    [
        ("cylinder", {"eccentricity_m": 0.02}, "eccentricity_mm = 20 mm: must be at most 12.15 mm"),
        ("cylinder", {"number": 2, "spacing_m": 0.01}, "spacing_mm = 10 mm: must be at least"),
        ("gas", {"discharge_pressure_pa": 1e6}, "discharge_pressure_bar = 10 bar: must exceed"),
        ("valve", {"lift_m": 0.003}, "lift_mm = 3 mm: must be at most 2 mm"),
        ("roller", {"inner_radius_m": 0.023}, "roller.inner_radius_mm = 23 mm: must be below"),
        ("vane", {"length_m": 0.009}, "vane.length_mm = 9 mm: must exceed the stroke"),
        ("rotary_shaft", {"sub_bearing_height_m": 0.0}, "must be at least 1 mm above"),
    ],
)
def test_sizes_that_do_not_fit_are_refused(table: str, values: dict, text: str) -> None:
    machine = single()
    tables = dict(iter(machine))
    tables[table] = dict(iter(tables[table])) | values
    with pytest.raises(ValueError, match=text):
        type(machine).model_validate(tables)


def test_current_that_does_not_carry_the_mean_load_is_refused() -> None:
    control = TorqueControl(highest_order=3, current_limit_a=5.0)
    with pytest.raises(ParameterError, match=r"current_limit_a = 5 A: must be at least 7\.\d+ A"):
        steady_cycle(changed("drive", control=control), 3000.0, SAMPLES)


def test_accumulator_has_modes_of_its_own_and_is_no_added_mass() -> None:
    machine = single()
    assert machine.accumulator is not None
    mounted = on_mounts(machine)
    assert "accumulator" in mounted.labels
    frequencies, shapes = mounted.natural_modes()
    assert len(frequencies) == 12
    body = mounted.labels.index("accumulator")
    swings = np.abs(shapes[6:, body, :3]).max() > np.abs(shapes[6:, 0, :3]).max()
    assert swings
    without = machine.model_copy(update={"accumulator": None})
    assert len(on_mounts(without).natural_modes()[0]) == 6
    study = va.load_study(ROOT / "pipelines" / "rolling_piston.toml")
    revolution = machine.revolution(3000.0, 144)
    added = added_by(study.options["none"], machine, revolution)
    assert added.figures["added_mass_kg"] == 0.0
