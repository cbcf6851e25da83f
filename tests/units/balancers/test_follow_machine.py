"""Options without dimensions of their own take those of the machine."""

import numpy as np
import pytest
from support import MACHINE_FILE, ROOT

import vibroacoustics as va
from vibroacoustics.balancers.lanchester import Lanchester
from vibroacoustics.balancers.twin_oldham import TwinOldham
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.mechanisms.tabulated.machine import oscillating_mass_moment


def test_twin_ring_is_the_ring_at_the_lower_counterweight() -> None:
    machine = va.load_machine(MACHINE_FILE)
    revolution = machine.revolution(2900.0, 64)
    (twin,) = TwinOldham().added(machine, revolution).parts
    planes = machine.require(va.Slider).planes
    assert twin.mass_kg == machine.require(va.OldhamRing).mass_kg
    assert twin.position_m[2] == pytest.approx(planes.lower_height_m)
    assert np.abs(twin.position_m[0]).max() == pytest.approx(
        machine.require(va.OldhamRing).stroke_m
    )
    own = TwinOldham(mass_kg=0.2, distance_below_ring_m=0.1).added(machine, revolution)
    assert own.parts[0].mass_kg == 0.2


def test_twin_ring_without_a_height_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    machine = va.load_machine(MACHINE_FILE)
    revolution = machine.revolution(2900.0, 64)
    ring = machine.require(va.OldhamRing)
    monkeypatch.setattr(type(machine), "capabilities", property(lambda _: (ring,)))
    with pytest.raises(ParameterError, match="distance_below_ring_mm: is missing"):
        TwinOldham().added(machine, revolution)


def test_lanchester_weights_are_at_the_radius_of_the_counterweights() -> None:
    machine = va.load_machine(ROOT / "data" / "machines" / "mayekawa_wbhe.toml")
    slider, revolution = machine.require(va.Slider), machine.revolution(1000.0, 64)
    parts = Lanchester(share_ratio=1.0).added(machine, revolution).parts
    mass_kg = 0.5 * slider.mass_kg * slider.amplitude_m / slider.planes.radius_m
    assert [part.mass_kg for part in parts] == pytest.approx([mass_kg, mass_kg])


@pytest.mark.parametrize("first_angle_rad", [0.0, 0.7, 3.0])
def test_sliding_mass_of_a_force_whatever_turns_beside_it(first_angle_rad: float) -> None:
    """0.3 kg m slide and 0.8 kg m turn; their forces are written out over the crank angle."""
    rotation = constant_rotation(1200.0, 48)
    angle, speed = rotation.crank_angle + first_angle_rad, 2.0 * np.pi * 20.0
    along = (0.3 + 0.8) * speed**2 * np.cos(angle)
    across = 0.8 * speed**2 * np.sin(angle)
    first = [2.0 * np.fft.rfft(force)[1] / 48 for force in (along, across)]
    assert oscillating_mass_moment(*first, 1200.0) == pytest.approx(0.3, rel=1e-9)
