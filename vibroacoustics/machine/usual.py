"""Which values are usual for a machine: outside, a decimal point or a unit may be wrong."""

import re
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from math import pi
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from .machine import Machine

DENSITY_KG_PER_M3: Final = (500.0, 20e3)
"""Density of a machine in its shell, from sheet around air to solid lead and more."""
MOUNTED_HZ: Final = (2.0, 60.0)
"""Natural frequency on mounts: below they sag by 60 mm, above nothing is isolated."""
FREE_MOTION_M: Final = 0.01
"""Largest displacement of a machine without mounts by its own forces."""


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


def usual_of(machine: "Machine", field: str, unit: str) -> Usual | None:
    """Range of a value by its name and unit; none where no rule fits.

    Parameters
    ----------
    machine : sizes and masses are relative to its own
    field : dotted, from the machine, in SI
    unit : suffix of the SI key
    """
    size = max(machine.shell.outer_diameter_m, machine.shell.height_m)
    mass = mass_kg(machine)
    scale = {"": 1.0, "size": size, "mass": mass, "volume": volume_m3(machine),
             "inertia": mass * size**2}  # fmt: skip
    for rule in _rules():
        if rule["unit"] == unit and re.fullmatch(rule.get("names", ".*"), field):
            scale_name = rule.get("of", "")
            lowest = rule["lowest"] * scale[scale_name]
            highest = rule["highest"] * scale[rule.get("of_highest", scale_name)]
            return Usual(field, lowest, highest, rule["why"])
    return None


def mass_kg(machine: "Machine") -> float:
    """Mass of shell and block."""
    block = machine.suspension.block.mass_kg if machine.suspension is not None else 0.0
    return machine.housing.mass_kg + block


def volume_m3(machine: "Machine") -> float:
    """Volume of the shell as a cylinder."""
    return pi * machine.shell.radius_m**2 * machine.shell.height_m


def of_density(machine: "Machine") -> Usual:
    """Mass of the machine, by the volume of its shell."""
    volume, block = volume_m3(machine), mass_kg(machine) - machine.housing.mass_kg
    lowest, highest = (density * volume - block for density in DENSITY_KG_PER_M3)
    least = 0.1 * block
    why = f"0.5 to 20 g/cm³ for the {1e3 * volume:.3g} litres of the shell"
    return Usual("housing.mass_kg", max(lowest, least), max(highest, least), why)


def of_mounts(machine: "Machine") -> Iterator[Usual]:
    """Stiffness of mounts and springs, by the mass that they carry."""
    feet = () if machine.feet is None else tuple(machine.feet.by_name)
    tables = ("mounts", *(f"feet.{name}" for name in feet))
    carried = [(table, mass_kg(machine), len(feet) or 4) for table in tables]
    if machine.suspension is not None:
        carried.append(("suspension.springs", machine.suspension.block.mass_kg, 4))
    for table, mass, number in carried:
        lowest, highest = ((2.0 * pi * hertz) ** 2 * mass / number for hertz in MOUNTED_HZ)
        why = f"a natural frequency of 2 to 60 Hz with {mass:.3g} kg on {number}"
        for way in ("lateral", "vertical"):
            yield Usual(f"{table}.{way}_stiffness_n_per_m", lowest, highest, why)


def doubt_of_forces(machine: "Machine", force_n: float, speed_rad_per_s: float) -> str:
    """What is doubtful in a force at order 1: how far it moves the machine; empty where nothing.

    Parameters
    ----------
    machine : which the force shakes
    force_n : peak
    speed_rad_per_s : of the shaft
    """
    mass = mass_kg(machine)
    motion = force_n / (mass * speed_rad_per_s**2)
    if motion <= FREE_MOTION_M:
        return ""
    return (
        f"order 1 of {force_n:.3g} N would move {mass:.3g} kg without mounts by "
        f"{1e3 * motion:.3g} mm; usual is at most {1e3 * FREE_MOTION_M:g} mm; are they in mN?"
    )


@cache
def _rules() -> list[dict[str, Any]]:
    text = files(__package__).joinpath("usual.toml").read_text(encoding="utf-8")
    rules: list[dict[str, Any]] = tomllib.loads(text)["rule"]
    return rules
