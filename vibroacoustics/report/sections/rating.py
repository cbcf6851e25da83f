"""Rating level at windows: whether the limit is met, which tone decides, options in rank."""

from typing import Any, Final

import xarray as xr

from ...base import rounding
from ...base.registry import register
from ...base.vocabulary import REFERENCE_OPTION
from ...results.bands import band
from ...results.estimates import has_samples, interval
from ...results.stored_study import nearest_speed, options, parameters
from ..blocks import Block, Text
from ..quantities import NO_BREAK
from ..tables import DataTable, Table, long_table
from . import Section, hold

_PERIOD: Final = {"night": "Night", "day": "Day"}
_VARIABLES: Final = ("rating_level", "rating_adjustment", "limit_probability")


def windows(results: xr.Dataset) -> list[str]:
    """Return the names of the windows."""
    return [str(name) for name in results["rating_window"].values]


def worst_window(results: xr.Dataset) -> str:
    """Return the window whose limit is least likely to be met; of equal ones the loudest."""
    here = results.sel(speed=nearest_speed(results), option=REFERENCE_OPTION)
    excess = here["rating_level"] - here["rating_limit"]

    def probability_and_margin(window: str) -> tuple[float, float]:
        case = {"rating_window": window}
        return float(here["limit_probability"].sel(case)), -float(excess.sel(case))

    return min(windows(results), key=probability_and_margin)


def rating_sentence(results: xr.Dataset, window: str, among: str = "") -> str:
    """Say the rating level at a window, its limit, and which tone decides.

    Parameters
    ----------
    results : results of a run
    window : name
    among : words that set the window beside others
    """
    speed, period = nearest_speed(results), _window(results, window)["period"]
    case = {"speed": speed, "option": REFERENCE_OPTION, "rating_window": window}
    level = band(results, "rating_level", **case).middle_text(rounding.level)
    limit = results["rating_limit"].sel(rating_window=window).item()
    return (
        f"Rating level at window {window}{among}: {level} dB(A){_tone_words(results, window)}. "
        f"{_PERIOD[period]} limit {limit:g}: {_verdict(results, case)}."
    )


def rating_table(results: xr.Dataset, window: str) -> Table:
    """Return probability, rating level and adjustment of every option, the likeliest first."""
    speed = nearest_speed(results)
    rows = []
    for option in ranked(results, window):
        case = {"speed": speed, "option": option, "rating_window": window}
        rows.append((
            option,
            _chance(results, case),
            band(results, "rating_level", **case).middle_and_ends(rounding.level),
            band(results, "rating_adjustment", **case).middle_and_ends(_step),
            decisive_tone(results, window, option) or "none",
        ))  # fmt: skip
    head = ("Option", "Met", "L_r, dB(A)", "K_T, dB", "Tone")
    limit = results["rating_limit"].sel(rating_window=window).item()
    caption = f"{window}, {speed:g} rpm, limit {limit:g} dB(A)"
    return Table(caption, head, tuple(rows), frozenset({0, 4}))


def ranked(results: xr.Dataset, window: str) -> list[str]:
    """Return the options by their probability of meeting the limit, then by level."""
    case = {"speed": nearest_speed(results), "rating_window": window}
    here = results[["limit_probability", "rating_level"]].sel(case)

    def probability_and_level(option: str) -> tuple[float, float]:
        chosen = here.sel(option=option)
        return -float(chosen["limit_probability"]), float(chosen["rating_level"])

    return sorted(options(results), key=probability_and_level)


def decisive_tone(results: xr.Dataset, window: str, option: str) -> str:
    """Name the tone that is most audible at a window; empty where no tone adds to the level.

    It has the largest upper end of the interval of its audibility: in samples tones take turns.
    """
    case = {"speed": nearest_speed(results), "option": option}
    adjustment = results["rating_adjustment"].sel({**case, "rating_window": window})
    if float(adjustment) <= 0.0:
        return ""
    receiver = _window(results, window)["receiver"]
    audibility = interval(results, "tone_audibility")["high"].sel({**case, "receiver": receiver})
    name = str(audibility["judged_tone"].values[int(audibility.argmax("judged_tone"))])
    order = name.removeprefix("order ")
    return name if order == name else f"{order}×"


def _tone_words(results: xr.Dataset, window: str) -> str:
    case = {"speed": nearest_speed(results), "option": REFERENCE_OPTION, "rating_window": window}
    name = decisive_tone(results, window, REFERENCE_OPTION)
    if not name:
        return ", nothing for tones"
    added = band(results, "rating_adjustment", **case).middle_text(_step)
    tone = name.replace("×", "× shaft speed")
    return f", including {added} dB for the tone at {tone}"


def _step(adjustment_db: float) -> str:
    return f"{adjustment_db:g}"


def _verdict(results: xr.Dataset, case: dict[str, Any]) -> str:
    chance = _chance(results, case)
    if not has_samples(results):
        return "met" if chance == "yes" else "exceeded"
    return f"met with {chance} probability"


def _chance(results: xr.Dataset, case: dict[str, Any]) -> str:
    """Probability of meeting the limit; yes or no without samples."""
    share = results["limit_probability"].sel(case).item()
    if not has_samples(results):
        return "yes" if share > 0.0 else "no"
    return f"{100.0 * share:.0f}{NO_BREAK}%"


def _window(results: xr.Dataset, name: str) -> dict[str, str]:
    table: dict[str, str] = parameters(results)["rating"]["windows"][name]
    return table


def _rules_words(results: xr.Dataset) -> str:
    rules = parameters(results)["rating"]["rules"]
    assumed = (
        " Its adjustments of 0, 3 and 6 dB by audibility (2 and 9 dB) are assumed."
        if rules == "ta-laerm"
        else ""
    )
    return (
        f"Rules: {rules}.{assumed} L_r: rating level; K_T: adjustment in it for the most audible "
        "tone. The option likeliest to meet the limit comes first. The machine runs at one speed "
        "in the whole operating time. The correction for the weather and other sources are "
        "neglected. Levels are not rounded. Other speeds are in rating.csv."
    )


def _blocks(results: xr.Dataset) -> list[Block]:
    blocks: list[Block] = []
    for window in windows(results):
        blocks += [Text(rating_sentence(results, window), "strong"), rating_table(results, window)]
    return [*blocks, Text(_rules_words(results), "note")]


def _data(results: xr.Dataset) -> dict[str, DataTable]:
    names = [name for name in map(str, results.data_vars) if name.startswith(_VARIABLES)]
    return {"rating.csv": long_table(results, [*names, "rating_limit"])}


register(Section("rating", "Rating level", _blocks, hold("rating_level"), 12.0, tables=_data))
