"""Tables of `balance`: weights, readings, answers and influence coefficients."""

from typing import Final

import numpy as np

from ...base import rounding
from ...base.arrays import ComplexArray
from ...design.bench.balanced_runs import BalancedRuns, shown_angle
from ...measured.trial_runs.settings import TrialRuns
from ...report.tables import DataTable, Table, cell, columns_of

_FEW: Final = rounding.three_digits
_NOISE: Final = 1e-9


def shown_phase_deg(settings: TrialRuns, value: complex) -> float:
    """Phase of a reading in the convention of the file, 0° to below 360°.

    Parameters
    ----------
    settings : file of the runs
    value : reading, its phase leading
    """
    sense = 1.0 if settings.phases == "lead" else -1.0
    return float(sense * np.angle(value, deg=True) % 360.0)


def shown_reading(settings: TrialRuns, value: complex) -> str:
    """Write a reading as the file does: `4.2@35`.

    Parameters
    ----------
    settings : file of the runs
    value : reading, its phase leading
    """
    return f"{_FEW(abs(value))}@{shown_phase_deg(settings, value):.0f}°"


def band(low: float, high: float) -> str:
    """Write a band; `unknown` where it is.

    Parameters
    ----------
    low, high : ends
    """
    return f"{_FEW(low)} to {_FEW(high)}" if np.isfinite(low) else "unknown"


def weights_table(result: BalancedRuns) -> Table:
    """Weights to add.

    Parameters
    ----------
    result : answer for runs
    """
    rows = tuple(
        (weight.plane, str(weight.hole or rounding.NOTHING), _FEW(1e3 * weight.mass_kg),
         f"{np.rad2deg(weight.angle_rad):.0f}",
         _FEW(1e3 * result.settings.planes[weight.plane].radius_m))
        for weight in result.weights
    )  # fmt: skip
    return Table("Weights to add", ("Plane", "Hole", "Mass, g", "Angle, °", "Radius, mm"), rows)


def readings_table(result: BalancedRuns) -> Table:
    """Readings before and after, with the band of what remains.

    Parameters
    ----------
    result : answer for runs
    """
    settings, runs = result.settings, result.runs
    rows = tuple(
        (sensor, f"{speed:.0f}", settings.sensors[sensor].unit,
         shown_reading(settings, result.before[row]), _FEW(result.remaining(row)),
         band(result.after_band[0, row], result.after_band[2, row]))
        for row, (sensor, speed) in enumerate(zip(runs.sensors, runs.speeds_rpm, strict=True))
    )  # fmt: skip
    head = ("Sensor", "rpm", "Unit", "Before", "After", "After, 80 %")
    return Table(f"Readings, {settings.amplitudes}", head, rows)


def answers_table(result: BalancedRuns) -> Table:
    """Weights and readings of every aim, before they are put in holes.

    Parameters
    ----------
    result : answer for runs
    """
    planes = result.settings.planes
    rows = []
    for name, moment in {"no weight": 0.0 * result.moment_kg_m, **result.answers}.items():
        masses = (
            f"{_FEW(1e3 * abs(each) / plane.radius_m)}@"
            f"{np.rad2deg(shown_angle(result.settings, plane, float(np.angle(each)))):.0f}°"
            if abs(each) > 0.0
            else rounding.NOTHING
            for each, plane in zip(moment, planes.values(), strict=True)
        )
        title = f"{name} (chosen)" if name == result.chosen else name
        rows.append((title, *masses, *map(_FEW, _remaining(result, moment))))
    unit = _unit_of_aim(result)
    head = ("Answer", *(f"{name}, g@°" for name in planes), f"rms, {unit}", f"largest, {unit}")
    return Table("What each answer leaves", head, tuple(rows))


def _unit_of_aim(result: BalancedRuns) -> str:
    """Unit of weighted readings."""
    sensors = [result.settings.sensors[name] for name in result.runs.sensors]
    if all(sensor.limit is not None for sensor in sensors):
        return "of limits"
    units = {sensor.unit for sensor in sensors}
    return units.pop() if len(units) == 1 else "of the largest of a unit"


def _remaining(result: BalancedRuns, moment: ComplexArray) -> tuple[float, float]:
    """Root mean square and largest of the weighted readings with moments."""
    size = result.problem.weight * np.abs(result.problem.residual(moment))
    size = np.where(
        size > _NOISE * np.max(result.problem.weight * np.abs(result.before)), size, 0.0
    )
    return float(np.sqrt(np.mean(size**2))), float(size.max())


def data_tables(result: BalancedRuns) -> dict[str, DataTable]:
    """Return the tables for programs, by the names of their files.

    Parameters
    ----------
    result : answer for runs
    """
    settings, runs = result.settings, result.runs
    weights = [
        (each.plane, "" if each.hole is None else float(each.hole), 1e3 * each.mass_kg,
         float(np.rad2deg(each.angle_rad)), 1e3 * settings.planes[each.plane].radius_m)
        for each in result.weights
    ]  # fmt: skip
    readings, influence = [], []
    for row, (sensor, speed) in enumerate(zip(runs.sensors, runs.speeds_rpm, strict=True)):
        before, after = result.before[row], result.after[row]
        bands = (*result.after_band, *result.expected_band)
        readings.append((
            sensor, float(speed), settings.sensors[sensor].unit,
            abs(before), shown_phase_deg(settings, before),
            result.remaining(row), shown_phase_deg(settings, after),
            *(cell(float(each[row])) for each in bands),
        ))  # fmt: skip
        for plane, value in zip(settings.planes, result.problem.influence[row], strict=True):
            influence.append((
                sensor, float(speed), plane, 1e-6 * abs(value), float(np.angle(value, deg=True))
            ))  # fmt: skip
    answers = [
        (name, plane, 1e3 * abs(each) / settings.planes[plane].radius_m,
         float(np.rad2deg(shown_angle(settings, settings.planes[plane], float(np.angle(each))))),
         *_remaining(result, moment), "yes" if name == result.chosen else "no")
        for name, moment in result.answers.items()
        for plane, each in zip(settings.planes, moment, strict=True)
    ]  # fmt: skip
    return {
        "weights.csv": columns_of(_WEIGHTS, weights),
        "readings.csv": columns_of(_READINGS, readings),
        "answers.csv": columns_of(_ANSWERS, answers),
        "influence.csv": columns_of(_INFLUENCE, influence),
    }


_WEIGHTS: Final = ("plane", "hole", "mass_g", "angle_deg", "radius_mm")
_READINGS: Final = (
    "sensor", "speed_rpm", "unit", "before", "before_phase_deg", "after", "after_phase_deg",
    "after_low", "after_median", "after_high", "expected_low", "expected_median", "expected_high",
)  # fmt: skip
_ANSWERS: Final = ("answer", "plane", "mass_g", "angle_deg", "rms", "largest", "chosen")
_INFLUENCE: Final = ("sensor", "speed_rpm", "plane", "unit_per_g_mm", "lead_with_rotation_deg")
