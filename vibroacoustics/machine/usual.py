"""Usual values of a machine: outside, a decimal point or a unit may be wrong."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, cached_property
from importlib.resources import files
from math import pi
from typing import Any, Final

from ..base.units import shaft_frequency_hz
from .shell import Shell

DENSITY_KG_PER_M3: Final = (500.0, 20e3)
"""Density of a machine in its shell, from sheet around air to solid lead and more."""
MOUNTED_HZ: Final = (2.0, 60.0)
"""Natural frequency on mounts: below they sag by 60 mm, above nothing is isolated."""
FREE_MOTION_M: Final = 0.01
"""Largest displacement of a machine without mounts by its own forces."""
INERTIA_FACTOR: Final = 5.0
"""Largest ratio of a force to m r ω²: counterweights leave a fifth or more, gas adds some."""


@dataclass(frozen=True)
class Usual:
    """Range of a value outside which it is doubted, not refused.

    Attributes
    ----------
    field : dotted, from the machine, in SI
    lowest, highest : usual size of the value, SI
    why : where the range comes from
    """

    field: str
    lowest: float
    highest: float
    why: str

    def holds(self, value: float) -> bool:
        """Whether a value is usual; zero is."""
        return value == 0.0 or self.lowest <= abs(value) <= self.highest


@dataclass(frozen=True)
class Scale:
    """Scale for sizes of parts.

    Attributes
    ----------
    shell : shell of the machine
    mass_kg : mass of shell and block
    block_kg : mass of the block on springs in the shell; zero without one
    """

    shell: Shell
    mass_kg: float
    block_kg: float

    @property
    def volume_m3(self) -> float:
        """Volume of the shell."""
        return self.shell.profile.volume_m3

    @cached_property
    def by_name(self) -> dict[str, float]:
        """Values that rules name, and 1 for rules that name none."""
        size = max(2.0 * self.shell.profile.radius_m, self.shell.profile.height_m)
        return {
            "": 1.0,
            "size": size,
            "mass": self.mass_kg,
            "volume": self.volume_m3,
            "inertia": self.mass_kg * size**2,
        }


def usual_of(scale: Scale, field: str, unit: str) -> Usual | None:
    """Range of a value by its name and unit; none where no rule fits.

    Parameters
    ----------
    scale : scale of the machine
    field : dotted, from the machine, in SI
    unit : suffix of the SI key
    """
    for rule in _rules():
        if rule["unit"] == unit and re.fullmatch(rule.get("names", ".*"), field):
            name = rule.get("of", "")
            lowest = rule["lowest"] * scale.by_name[name]
            highest = rule["highest"] * scale.by_name[rule.get("of_highest", name)]
            return Usual(field, lowest, highest, rule["why"])
    return None


def of_density(scale: Scale) -> Usual:
    """Mass of the machine without its block, by the volume of its shell."""
    lowest, highest = (
        max(density * scale.volume_m3 - scale.block_kg, 0.1 * scale.block_kg)
        for density in DENSITY_KG_PER_M3
    )
    why = f"0.5 to 20 g/cm³ for the {1e3 * scale.volume_m3:.3g} litres of the shell"
    return Usual("housing.mass_kg", lowest, highest, why)


def of_mounts(table: str, mass_kg: float, number: int) -> Iterator[Usual]:
    """Stiffness of mounts or springs, by the mass that they carry.

    Parameters
    ----------
    table : table of the mounts
    mass_kg : that all of them carry
    number : number of mounts
    """
    lowest, highest = ((2.0 * pi * hertz) ** 2 * mass_kg / number for hertz in MOUNTED_HZ)
    why = f"a natural frequency of 2 to 60 Hz with {mass_kg:.3g} kg on {number}"
    for direction in ("lateral", "vertical"):
        yield Usual(f"{table}.{direction}_stiffness_n_per_m", lowest, highest, why)


def doubt_of_forces(mass_kg: float, force_n: float, speed_rad_per_s: float) -> str:
    """Say what is doubtful in a force at order 1, from the motion of the machine; empty where
    nothing.

    Parameters
    ----------
    mass_kg : mass of the machine
    force_n : peak
    speed_rad_per_s : speed of the shaft
    """
    motion = force_n / (mass_kg * speed_rad_per_s**2)
    if motion <= FREE_MOTION_M:
        return ""
    return (
        f"order 1 of {force_n:.3g} N would move {mass_kg:.3g} kg without mounts by "
        f"{1e3 * motion:.3g} mm; usual is at most {1e3 * FREE_MOTION_M:g} mm; are they in mN?"
    )


def doubt_of_mass(
    table: str, force_n: float, mass_kg: float, radius_m: float, speed_rpm: float
) -> str:
    """Say what is doubtful in a moving mass beside a table of forces; empty where nothing.

    Parameters
    ----------
    table : table of the mass
    force_n : peak at order 1 along its stroke
    mass_kg, radius_m : mass and radius of the moving part; the radius is half its stroke
    speed_rpm : speed of the shaft
    """
    inertia = mass_kg * radius_m * (2.0 * pi * shaft_frequency_hz(speed_rpm)) ** 2
    if force_n / INERTIA_FACTOR <= inertia <= force_n * INERTIA_FACTOR:
        return ""
    return (
        f"order 1 along the stroke is {force_n:.3g} N at {speed_rpm:g} rpm; {table}.mass_kg = "
        f"{mass_kg:g} kg and {table}.amplitude_m = {radius_m:g} m make m r ω² = {inertia:.3g} N; "
        f"usual is a factor of {INERTIA_FACTOR:g} at most; are both of one machine?"
    )


@cache
def _rules() -> list[dict[str, Any]]:
    text = files(__package__).joinpath("usual.toml").read_text(encoding="utf-8")
    rules: list[dict[str, Any]] = tomllib.loads(text)["rule"]
    return rules
