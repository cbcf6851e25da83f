"""Page of `balance`, and the bench sheet: what goes where, and what is read then."""

from collections.abc import Iterator
from datetime import UTC, datetime
from typing import Final

import numpy as np

from ...base import rounding
from ...design.bench.balanced_runs import BalancedRuns, other_reading, shown_angle
from ...design.bench.grade import Grade, grade_name, grade_of
from ...mechanics.balancing.planes import DEPENDENT
from ...report.analysis import Analysis
from ...report.blocks import Bullets, Part, Pictures
from ...report.charts.svg import Picture
from ...report.tables import Table
from ...results.claim_kinds import BALANCE_GRADE
from ...results.conditional import ConditionalClaim, Finding, stated
from .of_study import study_part
from .picture import plane_picture, weight_words
from .tables import (
    answers_table,
    band,
    data_tables,
    readings_table,
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


def analysis_of_balancing(result: BalancedRuns, remarks: list[str]) -> Analysis:
    """Return weights, readings, answers and remarks; its further file is the bench sheet.

    Parameters
    ----------
    result : answer for runs
    remarks : doubts about it, a line each
    """
    weights, readings, answers = (
        weights_table(result),
        readings_table(result),
        answers_table(result),
    )
    of_study, study_tables = study_part(result)
    doubts = Part("remarks", "Remarks", (Bullets(tuple(remarks)),)) if remarks else None
    parts = (
        Part("weights", "Weights", (weights, Pictures(tuple(_pictures(result))))),
        Part("readings", "Readings", (readings,)),
        *([doubts] if doubts else []),
        *of_study,
        Part("answers", "Alternatives", (answers, Bullets(tuple(_alternatives(result))))),
        Part(
            "method", "Assumptions and limits", (Bullets((*conventions(result), *_METHOD)),), True
        ),
    )
    return Analysis(
        "balancing",
        result.settings.title,
        "Machine on the bench",
        f"{datetime.now(UTC):%Y-%m-%d %H:%M} UTC",
        _ABOUT,
        parts,
        summary=tuple(headlines(result)),
        claims=(_grade_claim(grade_of(result)),),
        shown=(weights, readings, answers),
        tables=data_tables(result) | study_tables,
        further={BENCH_NAME: bench_sheet(result).html()},
    )


def _pictures(result: BalancedRuns) -> Iterator[Picture]:
    return (plane_picture(result, name) for name in list(result.settings.planes)[:MOST_PICTURES])


def headlines(result: BalancedRuns) -> Iterator[str]:
    """Weights, the largest reading and the grade, a sentence each.

    Parameters
    ----------
    result : answer for runs
    """
    yield f"Add {weights_in_words(result)}."
    size = result.problem.weight * np.abs(result.before)
    row = int(size.argmax())
    sensor, unit = result.runs.sensors[row], result.settings.sensors[result.runs.sensors[row]].unit
    limits = band(result.after_band[0, row], result.after_band[2, row])
    yield (
        f"{sensor} at {result.runs.speeds_rpm[row]:.0f} rpm: "
        f"{rounding.three_digits(abs(result.before[row]))} to "
        f"{rounding.three_digits(result.remaining(row))} {unit} {result.settings.amplitudes} "
        f"(80 %: {limits})."
    )
    grade = grade_of(result)
    if grade is not None:
        yield (
            f"Balance quality: {rounding.three_digits(grade.before)} to "
            f"{rounding.three_digits(grade.after)} mm/s (80 %: {band(grade.low, grade.high)}), "
            f"{stated(_grade_claim(grade))}."
        )


def _grade_claim(grade: Grade | None) -> ConditionalClaim:
    """Grade by the upper end of its band, which needs the mass of the rotor and a scatter."""
    has_mass = grade is not None
    has_scatter = grade is None or not np.isnan(grade.high)
    findings = {
        "mass": Finding("stated" if has_mass else "not stated", has_mass),
        "scatter": Finding("known" if has_scatter else "not known", has_scatter),
    }
    return BALANCE_GRADE.claim(grade_name(grade.high) if grade else "", findings)


def weights_in_words(result: BalancedRuns) -> str:
    """Weights to add, in words.

    Parameters
    ----------
    result : answer for runs
    """
    return (
        "; ".join(f"{each.plane}: {weight_words(each)}" for each in result.weights) or "no weight"
    )


def conventions(result: BalancedRuns) -> list[str]:
    """State directions and zeros of angles and phases, a sentence each.

    Parameters
    ----------
    result : answer for runs
    """
    settings = result.settings
    phase = "after" if settings.phases == "lag" else "before"
    zeros = ", ".join(
        f"{name} {np.rad2deg(plane.zero_rad):.0f}°" for name, plane in settings.planes.items()
    )
    state = _weights_in(result) or "all trial weights are out"
    return [
        f"The shaft turns {settings.rotation}; angles of weights count {settings.angles} from the "
        f"zero of their plane (from the mark: {zeros}).",
        f"Phases {settings.phases}: the peak comes this angle {phase} the mark passes the tacho.",
        f"State of the machine: {state}.",
    ]


def _weights_in(result: BalancedRuns) -> str:
    """Name the weights that stay in; empty where none does."""
    planes = result.settings.planes
    weights = [
        f"{name} {rounding.three_digits(1e3 * abs(moment) / plane.radius_m)} g at "
        f"{np.rad2deg(shown_angle(result.settings, plane, float(np.angle(moment)))):.0f}°"
        for (name, plane), moment in zip(planes.items(), result.runs.installed, strict=True)
        if abs(moment) > 0.0
    ]
    return f"in it are {', '.join(weights)}; add the weights of the table to these" * bool(weights)


def _alternatives(result: BalancedRuns) -> Iterator[str]:
    """Condition of the planes, and weights for the other reading of the trial weights."""
    condition = result.dependence.condition
    yield f"Condition number of the planes: {condition:.3g} (above {DEPENDENT:g} they act alike)."
    other = other_reading(result)
    if other is None:
        return
    word = "removed" if result.settings.trial_weights == "left in" else "left in"
    planes = result.settings.planes
    masses = "; ".join(
        f"{name}: {1e3 * abs(each) / plane.radius_m:.3g} g at "
        f"{np.rad2deg(shown_angle(result.settings, plane, float(np.angle(each)))):.0f}°"
        for (name, plane), each in zip(planes.items(), other, strict=True)
    )
    yield f"If the trial weights were {word}, the weights would be others ({masses}): check that."


def bench_sheet(result: BalancedRuns) -> Analysis:
    """Return the sheet for the bench: which mass goes where, and what is read then.

    Parameters
    ----------
    result : answer for runs
    """
    settings, runs = result.settings, result.runs
    rows = tuple(
        (
            sensor,
            f"{speed:.0f}",
            shown_reading(settings, result.before[row]),
            _expected(result, row),
            settings.sensors[sensor].unit,
        )
        for row, (sensor, speed) in enumerate(zip(runs.sensors, runs.speeds_rpm, strict=True))
    )
    head = ("Sensor", "rpm", "Now", "Next reading, 80 % with its scatter", "Unit")
    turning, phases, state = conventions(result)
    steps = Bullets(
        (
            f"1. {state}",
            "2. Add the weights of the table. The radius is that of their centre of mass. "
            f"{turning}",
            f"3. Run again. Eight of ten readings of 1×, {settings.amplitudes}, lie within the "
            "bands.",
            f"4. Write amplitude and phase into the file of the runs, as a run with these weights: "
            f"the next answer uses it. {phases}",
        )
    )
    pictures = Pictures(tuple(_pictures(result)))
    expected = Table(f"Expected readings, {settings.amplitudes}", head, rows)
    blocks = (weights_table(result), steps, expected, pictures)
    return Analysis(
        "bench",
        f"Bench sheet: {settings.title}",
        "Machine on the bench",
        "",
        "Which mass goes where, and what is read then.",
        (Part("steps", "Steps", blocks),),
    )


def _expected(result: BalancedRuns, row: int) -> str:
    """Band of the next reading; without one what should remain."""
    low, _, high = result.expected_band[:, row]
    if np.isfinite(low):
        return band(low, high)
    return f"about {rounding.three_digits(result.remaining(row))}"
