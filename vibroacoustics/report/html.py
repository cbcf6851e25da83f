"""The report as one self-contained HTML page."""

import base64
import re
from collections.abc import Sequence
from importlib import resources
from typing import Any

import xarray as xr
from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from ..base.rounding import FORCE_FLOOR, LEVEL_FLOOR_DB, fixed
from . import (
    assumptions,
    housing,
    provenance,
    scores,
    source_tables,
    source_words,
    verdict,
)
from .comparison import comparison_tables
from .figures import Picture
from .option_facts import facts_table
from .option_verdict import option_verdicts
from .stopping import stopping_section
from .study import catalogue_receiver, has_inner_sources, other_receivers, parameters, words


def html(results: xr.Dataset, pictures: Sequence[Picture]) -> bytes:
    """The page; all figures and the style are inside, nothing is loaded from elsewhere."""
    environment = Environment(
        loader=PackageLoader("vibroacoustics.report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"data_address": _data_address, "breakable": _breakable}
    page = environment.get_template("report.html.j2")
    return page.render(_context(results, pictures)).encode()


def _context(results: xr.Dataset, pictures: Sequence[Picture]) -> dict[str, Any]:
    """Everything that the page shows, by section."""
    receiver = catalogue_receiver(results)
    return {
        "style": resources.files(__package__).joinpath("templates/style.css").read_text("utf-8"),
        "title": parameters(results)["title"],
        "machine": parameters(results)["machine"]["name"],
        "created": results.attrs["created_utc"],
        "receiver": receiver,
        "headline": verdict.headline(results),
        "reasons": verdict.reasons(results),
        "extremes": verdict.extremes_table(results),
        "options": option_verdicts(results),
        "facts": facts_table(results),
        "comparison": comparison_tables(results, receiver),
        "elsewhere": {name: comparison_tables(results, name) for name in other_receivers(results)},
        "pictures": {picture.name: picture for picture in pictures},
        "transfer": [p for p in pictures if p.name.startswith("transfer_")],
        "maps": [p for p in pictures if p.name == "line_map"],
        "spectra": [p for p in pictures if p.name.startswith("sources_")],
        "level_floor": fixed(LEVEL_FLOOR_DB, 0),
        "force_floor": f"{1e6 * FORCE_FLOOR:g}",
        **_inside(results),
        "stopping": stopping_section(results),
        **_housing(results),
        **_scores(results),
        **_sources(results),
    }


def _inside(results: xr.Dataset) -> dict[str, Any]:
    """The section on what carries the level; empty where inner sources are not modelled."""
    if not has_inner_sources(results):
        return {"inside": None}
    return {
        "inside": {
            "carrier": source_words.carrier_sentence(results),
            "shares": source_words.shares_sentence(results),
            "certainty": source_words.certainty_sentences(results),
            "sources": source_tables.source_tables(results),
            "changes": source_tables.change_tables(results),
            "figures": source_tables.figures_table(results),
        }
    }


def _housing(results: xr.Dataset) -> dict[str, Any]:
    return {
        "modes": housing.modes_table(results),
        "block": housing.block_table(results),
        "isolation": housing.isolation_sentence(results),
        "receivers": housing.receivers_table(results),
        "green": housing.green_sentence(results),
        "grid_error": housing.grid_error_sentence(results),
        "power": housing.sound_power_table(results),
    }


def _scores(results: xr.Dataset) -> dict[str, Any]:
    return {
        "criteria": scores.criteria_table(results),
        "values": scores.values_table(results),
        "scores": scores.scores_table(results),
        "published": scores.published_table(results),
        "published_source": scores.published_source(results),
        "wrong_sums": scores.wrong_sums(results),
        "draws": parameters(results)["scoring"]["random_weightings"],
        "scope": scores.scope_words(results),
    }


def _sources(results: xr.Dataset) -> dict[str, Any]:
    return {
        "records": assumptions.records_table(results),
        "assumed_count": assumptions.assumed_count(results),
        "remainder": assumptions.remainder_sentence(results),
        "order_words": words(results)["orders"],
        "not_modelled": assumptions.not_modelled(results),
        "structure_borne": assumptions.structure_borne_sentence(results),
        "errata": assumptions.errata_table(results),
        "provenance": provenance.provenance_table(results),
    }


def _breakable(text: str) -> Markup:
    """Text that may break after the dots and underscores of a name."""
    return Markup("<wbr>").join(re.split(r"(?<=[._])(?=[^\W\d_])", text))


def _data_address(png: bytes) -> str:
    return f"data:image/png;base64,{base64.b64encode(png).decode()}"
