"""Waves of Maxwell's stress in an air gap, the yoke as a ring, and both as sources."""

import numpy as np
import pytest
from sources_study import SOURCES_STUDY, case_of, path_of, run_made_up
from support import PIPELINES

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.frame import BEARING_HOUSING, STATOR
from vibroacoustics.machine.stator_yoke import STATOR_YOKE, YOKE_ORDERS, StatorYoke
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.mechanics.scroll_shaft import ScrollShaft
from vibroacoustics.sources.air_gap.parameters import AirGap
from vibroacoustics.sources.air_gap.waves import (
    MU_0,
    Wave,
    cosine,
    loads_of_stress,
    permeance,
    product,
    stress_pa,
)
from vibroacoustics.sources.cases import loaded_cases, loads_of
from vibroacoustics.study.loading import load_study
from vibroacoustics.transfer.yoke import YokeOnWall, ring_stiffness

SMOOTH = {"flux_density_t": 0.7, "stator_slots": 24, "rotor_slots": 30, "stator_slot_ratio": 0.0,
          "rotor_slot_ratio": 0.0, "static_eccentricity_ratio": 0.0,
          "dynamic_eccentricity_ratio": 0.0}  # fmt: skip
FORCES = {"sources.forces": {"kind": "induction-motor-forces"}}


@pytest.fixture(scope="module")
def study():
    changed = {**FORCES, "operation.supply_frequency_hz": [50.0]}
    return load_study(SOURCES_STUDY).replace(changed)


def gap(**values) -> AirGap:
    return AirGap(**{**SMOOTH, **values})


def ring(**values) -> StatorYoke:
    given = {"bore_radius_m": 0.035, "mean_radius_m": 0.07, "thickness_m": 0.02, "length_m": 0.08,
             "youngs_modulus_pa": 1.8e11, "density_kg_per_m3": 7600.0, "teeth_mass_ratio": 0.0,
             "loss_factor_ratio": 0.0, "fit_stiffness_n_per_m": 1e9}  # fmt: skip
    return StatorYoke(**{**given, **values})


# --- stress --------------------------------------------------------------------------------------


def test_two_poles_press_with_two_waves_at_twice_the_line():
    """B²/(2 μ0) cos²(θ - ωt) by hand: B²/(4 μ0) of two waves at twice the line, no more."""
    stress = stress_pa(cosine(Wave(1, 1, 0), 0.7 + 0j))
    assert {wave: abs(value) for wave, value in stress.items() if abs(value) > 1e-9} == {
        Wave(2, 2, 0): pytest.approx(0.7**2 / (4.0 * 4e-7 * np.pi), rel=1e-6)  # 97.5 kPa
    }


def test_backward_field_pulsates_all_around():
    """Forward times backward, B_f B_b/(2 μ0), has no wave at twice the line."""
    flux = cosine(Wave(1, 1, 0), 0.7 + 0j) | cosine(Wave(-1, 1, 0), 0.1 + 0j)
    stress = stress_pa(flux)
    assert abs(stress[Wave(0, 2, 0)]) == pytest.approx(0.7 * 0.1 / (2.0 * MU_0))
    assert abs(stress[Wave(-2, 2, 0)]) == pytest.approx(0.1**2 / (4.0 * MU_0))


def test_waves_are_the_stress_at_every_place_and_time():
    given = gap(stator_slot_ratio=0.2, rotor_slot_ratio=0.1, static_eccentricity_ratio=0.3,
                static_angle_rad=0.7, dynamic_eccentricity_ratio=0.2,
                dynamic_angle_rad=-1.1)  # fmt: skip
    mains = cosine(Wave(1, 1, 0), 0.7 * np.exp(0.3j)) | cosine(Wave(-1, 1, 0), 0.05j)
    stress = stress_pa(product(mains, permeance(given, 24, 30)))
    generator = np.random.default_rng(3)
    place, line, shaft = generator.uniform(0.0, 2.0 * np.pi, (3, 400))

    def real(waves):
        return sum(
            (value * np.exp(1j * (w.line * line + w.shaft * shaft - w.around * place))).real
            for w, value in waves.items()
        )

    flux = 0.7 * np.cos(line - place + 0.3) - 0.05 * np.sin(line + place)
    flux *= 1.0 - 0.2 * np.cos(24 * place)
    flux *= 1.0 - 0.1 * np.cos(30 * (place - shaft))
    flux *= 1.0 + 0.3 * np.cos(place - 0.7 + 0.0) + 0.2 * np.cos(place - shaft + 1.1)
    still = {
        wave: value / (2.0 * MU_0)
        for wave, value in product(*2 * (product(mains, permeance(given, 24, 30)),)).items()
        if (wave.line, wave.shaft) == (0, 0)
    }
    expected = flux**2 / (2.0 * MU_0)
    assert real(stress) + real(still) == pytest.approx(expected, rel=1e-9)


def test_pull_of_an_eccentric_rotor():
    """π r L B² ε/(2 μ0) on the rotor towards the narrow gap, turning with it; none together."""
    given = gap(dynamic_eccentricity_ratio=0.05)
    flux = product(cosine(Wave(2, 1, 0), 0.7 + 0j), permeance(given, 24, None))
    shaft = ScrollShaft(length_m=0.22, diameter_m=0.025, youngs_modulus_pa=2e11,
                        density_kg_per_m3=7850.0, main_bearing_height_m=0.185,
                        bearing_stiffness_n_per_m=1e8, rotor_height_m=0.1, rotor_length_m=0.08,
                        rotor_diameter_m=0.07, rotor_mass_kg=2.0, pin_mass_kg=1.0)  # fmt: skip
    yoke = ring()
    parts = loads_of_stress(stress_pa(flux), yoke, shaft, -0.02)[0, 1]
    pull = np.pi * 0.035 * 0.08 * 0.7**2 * 0.05 / (2.0 * MU_0)
    yoked = parts.pop(STATOR_YOKE)
    assert not yoked.any()
    assert parts[STATOR][:2] == pytest.approx([-pull, 1j * pull])
    assert np.abs(sum(parts.values())).max() < 1e-12 * pull  # forces and moments
    assert parts[BEARING_HOUSING][0] == pytest.approx(pull * 0.1 / 0.185)


# --- yoke and wall -------------------------------------------------------------------------------


@pytest.mark.parametrize("order", [2, 3, 5])
def test_ring_has_hoppes_frequencies(order):
    yoke = ring(teeth_mass_ratio=0.5)
    area, second = 0.02 * 0.08, 0.08 * 0.02**3 / 12.0
    exact = np.sqrt(1.8e11 * second / (7600.0 * 1.5 * area * 0.07**4))
    exact *= order * (order**2 - 1) / np.sqrt(order**2 + 1.0) / (2.0 * np.pi)
    stiffness = ring_stiffness(yoke, order, np.array([0.0, exact]))
    assert abs(stiffness[1]) < 1e-9 * abs(stiffness[0])
    assert stiffness[0] == pytest.approx(1.8e11 * second * (order**2 - 1) ** 2 / 0.07**4)


def test_wall_is_what_its_steady_flexibility_says(study):
    """Modes and what they leave out: the steady compliance is the same whatever modes there are."""
    path = path_of(study)
    every = YokeOnWall(ring(), path, 1.0)
    assert path.wall is not None
    for number in (2, 3):
        steady = path.wall.flexibility.of_band(path.structure.stator, number)
        slow = every.wall_compliance(number, np.array([1e-3]))[0]
        assert slow.real == pytest.approx(np.pi * 0.07 * steady, rel=1e-3)


def test_soft_ring_hands_all_on_and_a_stiff_one_little(study):
    path, frequency = path_of(study), np.array([100.0])
    soft = YokeOnWall(ring(youngs_modulus_pa=1.0, density_kg_per_m3=1e-9), path, 1.0)
    stiff = YokeOnWall(ring(youngs_modulus_pa=1e13), path, 1.0)
    full, little = soft.forces(frequency), stiff.forces(frequency)
    at = 2 * YOKE_ORDERS.index(2)  # component of the cosine
    rows = [row for row, mode in enumerate(path.modes) if mode.name == "n2_1_cos"]
    assert full[rows, at].real > 0.0
    assert np.abs(full[rows, at + 1]).max() == 0.0
    assert np.abs(little[rows, at]).max() < 1e-2 * np.abs(full[rows, at]).max()
    stiffness = ring_stiffness(stiff.yoke, 2, frequency)
    give = stiff.wall_compliance(2, frequency) + 2.0 * np.pi * 0.07 / 1e9
    share = little[rows, at] / full[rows, at]
    assert share[0] == pytest.approx(1.0 / (1.0 + stiffness * give), rel=1e-6)


def test_yoke_that_is_no_ring_is_refused():
    with pytest.raises(ValueError, match="reaches into the yoke"):
        ring(bore_radius_m=0.061)  # the yoke begins at 70 - 20 / 2 mm
    assert ring(bore_radius_m=0.059).bore_radius_m == 0.059


# --- sources -------------------------------------------------------------------------------------


def test_source_of_the_capacitor_motor(study):
    forces = loads_of(study, case_of(study))["forces"]
    tones = {tone.name: tone for tone in forces.tones}
    twice = tones["2 x line"]
    assert twice.frequency_hz == 100.0
    two = np.abs(twice.loads[STATOR_YOKE].reshape(-1, 2)[YOKE_ORDERS.index(2)])
    by_hand = 0.7**2 / (4.0 * MU_0) * 0.08 * 0.0355 / 0.068
    assert two == pytest.approx(by_hand, rel=0.03)  # slots and eccentricity add their squares
    assert HOUSING not in twice.loads
    parts = [load for port, load in twice.loads.items() if port != STATOR_YOKE]
    assert np.abs(sum(parts)).max() < 1e-9
    assert np.abs(forces.lines[STATOR][0, 1]) > 10.0  # the pull that turns with the shaft


@pytest.mark.long
def test_forces_sound_in_a_study(study):
    """With samples; the yoke is part of what tells one path from another."""
    fewer = {f"options.{name}": None for name in study.options if name != "none"}
    small = study.replace({**fewer, "sources.keys": None, "uncertainty.random_samples": 4})
    results = run_made_up(small, gain=0.2)
    level = results["source_level"].sel(option="none", sound_source="forces")
    assert (level > -50.0).all()
    sampled = results["source_level_by_sample"].sel(option="none", sound_source="forces")
    assert sampled.std("sample").min() > 0.1
    assert "stator_yoke.thickness_m" in results["uncertain_parameter"].values


def test_all_of_the_synchronous_motor_are_orders():
    values = {"operation.speed_rpm": [2900.0], "operation.maximum_order": 40,
              "sources.keys": None,
              "sources.forces": {"kind": "synchronous-motor-forces"}}  # fmt: skip
    study = load_study(PIPELINES / "copeland_inverter.toml").replace(values)
    case = case_of(study)
    _, loads = loaded_cases(study, {(2900.0, "none"): case})
    forces = loads[2900.0, "none"]["forces"]
    assert not forces.tones
    sizes = (
        np.abs(forces.lines[STATOR_YOKE]).reshape(len(YOKE_ORDERS), 2, -1).max(axis=1)
    )  # (order around, order)
    assert np.flatnonzero(sizes[YOKE_ORDERS.index(3)] > 100.0).tolist() == [6]  # 9 slots - 6 poles


def test_measured_modes_are_refused(study):
    path = path_of(study)
    without = type(path)((), path.structure, None, 0.08, np.arange(0))
    measured = YokeOnWall(ring(), without, 1.0)
    with pytest.raises(ParameterError, match="leave magnetic forces out"):
        measured.forces(np.array([100.0]))
