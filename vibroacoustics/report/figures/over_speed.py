"""The pictures over the speed of a study, each in the width of the page."""

import xarray as xr

from ...base.vocabulary import REFERENCE_OPTION
from ...results.estimates import has_samples
from ...results.stored_study import catalogue_receiver, has_sources
from ..bands import INTERVAL
from .campbell import LOUD_DB, campbell
from .levels_over_speed import levels_over_speed, source_levels_over_speed
from .orders_over_speed import over_speed_picture
from .speed_maps import MAP_RANGE_DB, speed_frequency_map
from .style import Picture, in_both_widths

_SHADED = "Shaded: speeds to avoid without a balancer."


def over_speed_figures(results: xr.Dataset) -> list[Picture]:
    """Levels, sources, orders, map and Campbell diagram at the catalogue's microphone."""
    pictures = [_levels(results)]
    if has_sources(results):
        pictures.append(_sources(results))
    orders = over_speed_picture(results, "orders_over_speed")
    return [*pictures, orders, _map(results), _campbell(results)]


def _bands(results: xr.Dataset) -> str:
    if not has_samples(results):
        return ""
    return (
        f" Lines: medians. Bands: {INTERVAL} of the samples, which count by how "
        "well they agree with what was published or measured."
    )


def _levels(results: xr.Dataset) -> Picture:
    at = catalogue_receiver(results)
    return in_both_widths(
        "levels_over_speed",
        f"A-weighted level at {at} over the speed, total and modelled, for every option.",
        f"A-weighted level at {at}: total, with what is not modelled, and modelled sources alone."
        f"{_bands(results)} {_SHADED}",
        lambda width: levels_over_speed(results, width_inch=width),
    )


def _sources(results: xr.Dataset) -> Picture:
    at = catalogue_receiver(results)
    return in_both_widths(
        "sources_over_speed",
        f"A-weighted level of each source at {at} over the speed.",
        f"Each source alone at {at}, option {REFERENCE_OPTION}, and all that is modelled, A-"
        f"weighted.{_bands(results)} {_SHADED}",
        lambda width: source_levels_over_speed(results, width_inch=width),
    )


def _map(results: xr.Dataset) -> Picture:
    at = catalogue_receiver(results)
    return in_both_widths(
        "speed_frequency_map",
        f"Level of the lines at {at} over speed and frequency.",
        f"Lines of all sources at {at} over speed and frequency, option {REFERENCE_OPTION}, "
        f"unweighted, {MAP_RANGE_DB:g} dB shown; noise is not in it.",
        lambda width: speed_frequency_map(results, width_inch=width),
    )


def _campbell(results: xr.Dataset) -> Picture:
    at = catalogue_receiver(results)
    return in_both_widths(
        "campbell",
        "Campbell diagram: orders and tones over the speed, natural frequencies of mounts, shell "
        "and gas as level lines.",
        f"Campbell diagram: level lines are natural frequencies, sloping ones orders, dotted ones "
        f"other tones, the loudest at {at}. Large dots: crossings where the line is within "
        f"{LOUD_DB:g} dB of all that is modelled. {_SHADED}",
        lambda width: campbell(results, width_inch=width),
    )
