"""Page of `balance`, and the bench sheet: what goes where, and what is read then."""

from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Final

import numpy as np

from ...base import rounding
from ...design.bench.balanced_runs import BalancedRuns, other_reading, shown_angle
from ...design.bench.grade import grade_name, grade_of
from ...report.analysis import Analysis
from ...report.blocks import Bullets, Part, Pictures
from ...report.charts.svg import Picture
from ...report.tables import Table
from .picture import plane_picture, weight_words
from .tables import (
    answers_table,
    band,
    data_tables,
    readings_table,
    remaining,
    shown_reading,
    weights_table,
)

MOST_PICTURES: Final = 8
BENCH_NAME: Final = "bench.html"
_ABOUT: Final = "Weights that balance the machine on the bench, from runs with trial weights."
_METHOD: Final = (
    "Readings are b = b0 + A u at 1x: least squares over all runs give b0 and A together (Goodman, "
    "J. Eng. Ind. 86 (1964) 273). Weights of least squares make the sum of squares least, those of "
    "least worst the largest reading.",
    "Bands hold 80 %, from the scatter of repeats, of blocks of recordings, or as stated.",
    "Grade: e omega of the sum over the planes (ISO 21940-11).",
)


def analysis_of_balancing(found: BalancedRuns, remarks: list[str]) -> Analysis:
    """Return weights, readings, answers and remarks; its further file is the bench sheet.

    Parameters
    ----------
    found : answer for runs
    remarks : doubts about it, a line each
    """
    weights, readings, answers = weights_table(found), readings_table(found), answers_table(found)
    doubts = Part("remarks", "Remarks", (Bullets(tuple(remarks)),)) if remarks else None
    parts = (
        Part("weights", "Weights", (weights, Pictures(tuple(_pictures(found))))),
        Part("readings", "Readings", (readings,)),
        *([doubts] if doubts else []),
        Part("answers", "Alternatives", (answers, Bullets(tuple(_alternatives(found))))),
        Part("method", "Assumptions and limits", (Bullets((*conventions(found), *_METHOD)),), True),
    )
    return Analysis(
        "balancing",
        found.settings.title,
        "Machine on the bench",
        f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC",
        _ABOUT,
        parts,
        summary=tuple(headlines(found)),
        shown=(weights, readings, answers),
        tables=data_tables(found),
        further={BENCH_NAME: bench_sheet(found).html()},
    )


def _pictures(found: BalancedRuns) -> Iterator[Picture]:
    return (plane_picture(found, name) for name in list(found.settings.planes)[:MOST_PICTURES])


def headlines(found: BalancedRuns) -> Iterator[str]:
    """Weights, the largest reading and the grade, a sentence each.

    Parameters
    ----------
    found : answer for runs
    """
    yield f"Add {weights_in_words(found)}."
    size = found.problem.weight * np.abs(found.before)
    row = int(size.argmax())
    sensor, unit = found.runs.sensors[row], found.settings.sensors[found.runs.sensors[row]].unit
    limits = band(found.after_band[0, row], found.after_band[2, row])
    yield (
        f"{sensor} at {found.runs.speeds_rpm[row]:.0f} rpm: "
        f"{rounding.three_digits(abs(found.before[row]))} to "
        f"{rounding.three_digits(remaining(found, row))} {unit} {found.settings.amplitudes} "
        f"(80 %: {limits})."
    )
    grade = grade_of(found)
    if grade is not None:
        yield (
            f"Balance quality: {rounding.three_digits(grade.before)} to "
            f"{rounding.three_digits(grade.after)} mm/s (80 %: {band(grade.low, grade.high)}), "
            f"{grade_name(grade.after if np.isnan(grade.high) else grade.high)}."
        )


def weights_in_words(found: BalancedRuns) -> str:
    """Weights to add, in words.

    Parameters
    ----------
    found : answer for runs
    """
    return "; ".join(f"{each.plane}: {weight_words(each)}" for each in found.weights) or "no weight"


def conventions(found: BalancedRuns) -> list[str]:
    """State directions and zeros of angles and phases, a sentence each.

    Parameters
    ----------
    found : answer for runs
    """
    settings = found.settings
    phase = "after" if settings.phases == "lag" else "before"
    zeros = ", ".join(
        f"{name} {np.rad2deg(plane.zero_rad):.0f}°" for name, plane in settings.planes.items()
    )
    state = (
        "weights of all runs stay in, add these to them"
        if np.any(np.abs(found.runs.installed) > 0.0)
        else "all trial weights are out"
    )
    return [
        f"The shaft turns {settings.rotation}; angles of weights count {settings.angles} from the "
        f"zero of their plane (from the mark: {zeros}).",
        f"Phases {settings.phases}: the peak comes this angle {phase} the mark passes the tacho.",
        f"State of the machine: {state}.",
    ]


def _alternatives(found: BalancedRuns) -> Iterator[str]:
    """Condition of the planes, and weights for the other reading of the trial weights."""
    condition = found.dependence.condition
    yield f"Condition number of the planes: {condition:.3g} (above 15 they act alike)."
    other = other_reading(found)
    if other is None:
        return
    word = "removed" if found.settings.trial_weights == "left in" else "left in"
    planes = found.settings.planes
    masses = "; ".join(
        f"{name}: {1e3 * abs(each) / plane.radius_m:.3g} g at "
        f"{np.rad2deg(shown_angle(found.settings, plane, float(np.angle(each)))):.0f}°"
        for (name, plane), each in zip(planes.items(), other, strict=True)
    )
    yield f"If the trial weights were {word}, the weights would be others ({masses}): check that."


def bench_sheet(found: BalancedRuns) -> Analysis:
    """Return the sheet for the bench: which mass goes where, and what is read then.

    Parameters
    ----------
    found : answer for runs
    """
    settings, runs = found.settings, found.runs
    rows = tuple(
        (
            sensor,
            f"{speed:.0f}",
            shown_reading(settings, found.before[row]),
            _expected(found, row),
            settings.sensors[sensor].unit,
        )
        for row, (sensor, speed) in enumerate(zip(runs.sensors, runs.speeds_rpm, strict=True))
    )
    head = ("Sensor", "rpm", "Now", "Expected, 80 %", "Unit")
    steps = Bullets(
        (
            *conventions(found)[::-1],
            "Add the weights of the table. Run again; the readings should be within the bands.",
            "Write the readings into the file as a run with these weights: the next answer uses "
            "it.",
        )
    )
    pictures = Pictures(tuple(_pictures(found)))
    expected = Table(f"Expected readings, {settings.amplitudes}", head, rows)
    blocks = (weights_table(found), steps, expected, pictures)
    return Analysis(
        "bench",
        f"Bench sheet: {settings.title}",
        "Machine on the bench",
        "",
        "Which mass goes where, and what is read then.",
        (Part("steps", "Steps", blocks),),
    )


def _expected(found: BalancedRuns, row: int) -> str:
    """Band of the next reading; without one what should remain."""
    low, _, high = found.expected_band[:, row]
    if np.isfinite(low):
        return band(low, high)
    return f"about {rounding.three_digits(remaining(found, row))}"
