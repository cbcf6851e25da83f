"""Two charts of the first screen; forces, lines and the machine folded."""

from collections.abc import Mapping, Sequence
from typing import Final, Literal, TypeAlias

import numpy as np
import xarray as xr

from ....base.registry import register
from ....results.estimates import has_samples
from ....results.left_out import lines_of
from ....results.stored_study import balancers, catalogue_receiver, other_receivers, parameters
from ...blocks import Beside, Block, Bullets, Details, Light, LightRow, Lights, Pictures, Text
from ...drawing.picture import machine_picture
from ...option_verdict import BETTER, MIXED, NO_CHANGE, UNCERTAIN, WORSE, judge, option_verdicts
from ...quantities import FOOT_FORCE, FORCE, LINE, MOMENT, TOTAL
from ...shifts import Shift, extent, level_word, measurable, shift
from .. import Section, text
from ..example import example_words
from ..scores import ranking_sentence
from .words import changes, contributions

FULL_SCALE: Final = {"%": 100.0, "dB": 20.0}
"""Change at which a bar reaches the end of its cell."""

Word: TypeAlias = Literal["better", "worse", "mixed", "uncertain", "no change"]
_WORDS: Final[dict[str, Word]] = {
    BETTER: "better", WORSE: "worse", MIXED: "mixed", UNCERTAIN: "uncertain",
    NO_CHANGE: "no change",
}  # fmt: skip


_OF_TOTAL: Final[Mapping[str, Word]] = {
    "louder": "worse", "quieter": "better", "uncertain": "uncertain", "no change": "no change",
}  # fmt: skip


def lights(results: xr.Dataset) -> Lights | None:
    """A row an option, a column a quantity that can be measured; None without options."""
    if not balancers(results):
        return None
    verdicts = option_verdicts(results)
    rows = tuple(
        LightRow(of.option, _WORDS[of.judgement], _row(results, of.option)) for of in verdicts
    )
    receiver = catalogue_receiver(results)
    elsewhere = ("1× line, others, dB",) if other_receivers(results) else ()
    head = (
        "Option", "1× force, %", "1× moment, %", "1× foot force, %", "total level, dB",
        "1× line, dB", *elsewhere,
    )  # fmt: skip
    others = " and at the other microphones" if elsewhere else ""
    caption = f"Each option against no balancer; levels at {receiver}{others}"
    return Lights(caption, head, rows, _note(results))


def light(shifts: Sequence[Shift]) -> Light:
    """The light of a quantity, at one microphone or several.

    Better and worse are as the verdicts say; uncertain is what is neither, although the band of
    the samples reaches beyond what could be measured.
    """
    full = FULL_SCALE[shifts[0].unit]
    within = extent(shifts)
    ends = np.nan_to_num([within.lowest, within.highest]) / full
    low, high = np.clip(ends, -1.0, 1.0).tolist()
    least = shifts[0].least
    zone = least.level_db if shifts[0].quantity.is_level else 100.0 * least.force_ratio
    return Light(_word(shifts), _change(shifts), (low, high), min(zone / full, 1.0))


def _row(results: xr.Dataset, option: str) -> tuple[Light, ...]:
    by_quantity = [
        [shift(results, quantity, option)] for quantity in (FORCE, MOMENT, FOOT_FORCE, TOTAL, LINE)
    ]
    elsewhere = [shift(results, LINE, option, name) for name in other_receivers(results)]
    return tuple(light(shifts) for shifts in [*by_quantity, elsewhere] if shifts)


def _word(shifts: Sequence[Shift]) -> Word:
    if shifts[0].quantity == TOTAL:
        return _OF_TOTAL[level_word(shifts[0])]
    unsure = any(shift.is_uncertain for shift in shifts)
    rises = any(shift.rises for shift in shifts)
    return _WORDS[judge(rises, any(shift.falls for shift in shifts), unsure)]


def _change(shifts: Sequence[Shift]) -> str:
    """The range over samples, speeds and microphones; a word where there was or is nothing."""
    first, floor = shifts[0], shifts[0].quantity.floor
    if len(shifts) == 1 and first.before.min() < floor:
        return "appears" if first.after.max() >= floor else "0"
    if len(shifts) == 1 and first.after.max() < floor:
        return "vanishes"
    return first.written(extent(shifts))


def _note(results: xr.Dataset) -> str:
    least = measurable(results)
    scope = "80 % intervals" if has_samples(results) else "nominal values"
    return (
        f"Numbers and bars: {scope} at the speed of the largest change; bars end at ±100 % and "
        f"±20 dB. Grey: less than {100.0 * least.force_ratio:g} % or {least.level_db:g} dB, not "
        "measurable. Mixed: better at some microphones or speeds, worse at others."
    )


def _blocks(results: xr.Dataset) -> list[Block]:
    contributed, changed = contributions(results), changes(results)
    charts = contributed if changed is None else Beside(contributed, changed)
    words = [
        *left_out_words(results), *coarse_words(results), *text(example_words(results)),
    ]  # fmt: skip
    return [*words, charts, *_details(results)]


def left_out_words(results: xr.Dataset) -> list[Block]:
    """Say what is omitted, as it failed or was not wanted; nothing where nothing is."""
    lines = lines_of(results)
    return [Text("This report is not complete:"), Bullets(tuple(lines))] if lines else []


def coarse_words(results: xr.Dataset) -> list[Block]:
    """Say what was made coarser for a first look; nothing of a run as its study says."""
    coarsened = parameters(results).get("coarsened", ())
    first = "This is a first look, coarser than the study says:"
    return [Text(first), Bullets(tuple(coarsened))] if coarsened else []


def _details(results: xr.Dataset) -> list[Block]:
    """The machine, and each option's forces and lines."""
    picture, chart = machine_picture(results), lights(results)
    blocks: list[Block] = [Pictures((picture,))] if picture else []
    if chart is not None:
        blocks += [chart, Text(ranking_sentence(results, option_verdicts(results)))]
    return [Details("Machine, 1× forces and lines, ranking", tuple(blocks))] if blocks else []


register(Section("verdict", "Summary", _blocks, position=10.0, folded=False))
