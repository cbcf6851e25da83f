"""Operating point, mounting, motion of feet as in a test report of EN 12102-1; what is missing."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array, ComplexArray
from ..base.constants import AIR_DENSITY_KG_PER_M3, SPEED_OF_SOUND_M_PER_S
from ..base.revolution import shell_profile
from ..base.vocabulary import AXES, RIGID_BODY_DOFS
from ..results.data_sheet import Fact, Vibration
from ..results.stored_study import operating_points, parameters

_ANGLES_PER_ORDER: Final = 32
"""Number for the highest order: a peak is then found within half a percent."""
WORDS: Final = (
    "rigid-body motion of the housing on its mounts at shaft orders, all sources together, with "
    "the nominal values; it neglects bending of the wall, lines of the motor and noise"
)


def point_velocity(velocity: ComplexArray, offset_m: Array) -> ComplexArray:
    """v + w × r of a rigid body, (axis, order).

    Parameters
    ----------
    velocity : shape (dof, order), complex peaks at the centre of mass, m/s and rad/s
    offset_m : offset of the point from the centre of mass, shape (3,)
    """
    turned = np.cross(velocity[3:], offset_m[:, None], axis=0)
    return np.asarray(velocity[:3] + turned)


def peak_to_peak(peaks: ComplexArray, orders: Array) -> Array:
    """Highest less lowest value over a revolution of a sum of orders, (...,).

    Parameters
    ----------
    peaks : complex peaks, shape (..., order)
    orders : orders, whole numbers, shape (order,)
    """
    count = int(_ANGLES_PER_ORDER * max(orders.max(initial=1.0), 1.0))
    angle = 2.0 * np.pi * np.arange(count) / count
    history = (peaks @ np.exp(1j * np.outer(orders, angle))).real
    return np.asarray(np.ptp(history, axis=-1))


def vibration(case: xr.Dataset, points_m: Mapping[str, Array]) -> tuple[Vibration, ...]:
    """Return the motion of every foot and point in every direction.

    Parameters
    ----------
    case : results at an option and a speed
    points_m : further points from the centre of mass, (3,), by name
    """
    velocity = case["velocity_order"].sum("source").sel(dof=list(RIGID_BODY_DOFS))
    hertz = case["order_frequency"].values
    sounding = hertz > 0.0
    peaks = velocity.transpose("dof", "order").values[:, sounding]
    orders, omega = case["order"].values[sounding].astype(float), 2.0 * np.pi * hertz[sounding]
    feet = dict(zip(map(str, case["foot"].values), case["foot_position"].values, strict=True))
    motions = []
    for name, offset in {**feet, **points_m}.items():
        motion = point_velocity(peaks, offset)
        displacement = peak_to_peak(motion / (1j * omega), orders)
        speed, acceleration = _rms(motion), _rms(motion * omega)
        motions += [
            Vibration(
                point=name,
                direction=axis,
                displacement_peak_to_peak_m=float(displacement[row]),
                velocity_rms_m_per_s=float(speed[row]),
                acceleration_rms_m_per_s2=float(acceleration[row]),
            )
            for row, axis in enumerate(AXES)
        ]
    return tuple(motions)


def offsets_m(
    results: xr.Dataset, points_m: Mapping[str, tuple[float, float, float]]
) -> dict[str, Array]:
    """Named points from the centre of mass, the top of the shell among them.

    Parameters
    ----------
    results : results of a run
    points_m : x, y and height above the floor, as microphones are given
    """
    shell = parameters(results)["machine"]["shell"]
    below = shell["centre_of_mass_height_m"] + shell["floor_clearance_m"]
    top = below + shell_profile(shell).top_z_m
    named = {"top of the shell": (0.0, 0.0, top), **points_m}
    return {name: np.array([x, y, height - below]) for name, (x, y, height) in named.items()}


def _rms(peaks: ComplexArray) -> Array:
    return np.asarray(np.sqrt(0.5 * np.sum(np.abs(peaks) ** 2, axis=-1)))


_PRESSURES: Final = {
    "suction_pressure_pa": "suction pressure",
    "discharge_pressure_pa": "discharge pressure",
}
_BAR: Final = 1e-5
_NOT_AVAILABLE: Final = (
    "a measurement of the machine: all values are predicted",
    "L_pA and its uncertainty at a work station: a compressor has none",
    "peak level L_pC,peak",
    "name of the test laboratory, date of the test, and a noise test code that was followed",
    "background noise and corrections K1 and K2: the prediction has none",
)
"""Parts of a declaration by ISO 4871."""
FEWEST_MICROPHONES: Final = 10
"""Least number of microphones on the hemisphere of ISO 3744."""


def operating(case: xr.Dataset) -> tuple[Fact, ...]:
    """Return speed, supply, refrigerant and pressures of an option at a speed."""
    study = parameters(case)
    facts = [
        Fact(name="shaft speed", value=float(case["speed"]), unit="rpm"),
        Fact(name="balancing option", value=str(case["option"].values)),
    ]
    if "supply_frequency" in case:
        facts.append(_number("supply frequency", float(case["supply_frequency"]), "Hz"))
    point, _ = operating_points(case)
    facts.append(Fact(name="operating point", value=point or "values of the machine's file"))
    refrigerant = study["machine"].get("refrigerant") or "not stated in the machine's file"
    facts.append(Fact(name="refrigerant", value=refrigerant))
    facts += _pressures(study["machine"])
    facts += _sources_of_pressures(study["records"])
    mass = case["reported_figure"].sel(figure="added_mass_kg").item()
    if np.isfinite(mass):
        facts.append(_number("mass added by the option", mass, "kg"))
    return tuple(facts)


def mounting(case: xr.Dataset) -> tuple[Fact, ...]:
    """Return feet, mounts, floor and size of the machine, and the air."""
    study = parameters(case)
    machine, around = study["machine"], study["radiation"]["surroundings"]
    yielding = machine.get("floor") or machine.get("floor_mobility")
    measured = (study.get("measured") or {}).get("floor")
    floor = "compliant under the feet" if yielding or measured else "rigid under the feet"
    shell = machine["shell"]
    outside = shell_profile(shell)
    return (
        _number("mass on the mounts", machine["housing"]["mass_kg"], "kg"),
        Fact(name="feet", value=float(case.sizes["foot"])),
        *_mounts(machine),
        Fact(name="floor", value=f"{'hard' if around['floor'] else 'none'} to sound, {floor}"),
        _number("height of the shell above the floor", 1e3 * shell["floor_clearance_m"], "mm"),
        _number("height of the shell", 1e3 * outside.height_m, "mm"),
        _number("diameter of the shell", 2e3 * outside.radius_m, "mm"),
        Fact(name="pipes", value="none: their stiffness and their sound are not modelled"),
        _number("density of the air", AIR_DENSITY_KG_PER_M3, "kg/m³"),
        _number("speed of sound", SPEED_OF_SOUND_M_PER_S, "m/s"),
    )


def not_available(microphones: int) -> tuple[str, ...]:
    """Return what a declaration by ISO 4871 states and the prediction does not have."""
    if microphones >= FEWEST_MICROPHONES:
        return _NOT_AVAILABLE
    surface = f"the {FEWEST_MICROPHONES} microphones of ISO 3744: the study has {microphones}"
    return (*_NOT_AVAILABLE, surface)


def _mounts(machine: Mapping[str, Any]) -> Iterator[Fact]:
    feet = {name: foot for name, foot in (machine.get("feet") or {}).items() if foot}
    others = [name for name, foot in feet.items() if _differs(foot)]
    if machine.get("mount_stiffness"):
        yield Fact(name="stiffness of the mounts", value="over frequency, from a file")
    else:
        mounts = machine["mounts"]
        for direction in ("vertical", "lateral"):
            stiffness = 1e-3 * mounts[f"{direction}_stiffness_n_per_m"]
            yield _number(f"{direction} stiffness of a mount", stiffness, "N/mm")
        yield _number("loss factor of the mounts", 100.0 * mounts["loss_factor_ratio"], "%")
    if others:
        yield Fact(name="feet with mounts that differ", value=", ".join(others))


def _differs(foot: Mapping[str, Any]) -> bool:
    return any(value is not None for name, value in foot.items() if "stiffness" in name)


def _pressures(machine: Mapping[str, Any]) -> Iterator[Fact]:
    """Suction and discharge pressure of the first table of the machine that has them."""
    tables = [machine, *(table for table in machine.values() if isinstance(table, dict))]
    for key, words in _PRESSURES.items():
        values = [table[key] for table in tables if table.get(key)]
        if values:
            yield _number(words, _BAR * values[0], "bar")


def _sources_of_pressures(records: Iterable[Mapping[str, Any]]) -> Iterator[Fact]:
    """Source of the suction pressure in the machine's file, which names the operating point."""
    for record in records:
        if str(record["field"]).rpartition(".")[2].startswith("suction_pressure_"):
            yield Fact(name="source of the suction pressure", value=str(record["source"]))
            return


def _number(name: str, value: float, unit: str) -> Fact:
    return Fact(name=name, value=float(f"{value:.4g}"), unit=unit)
