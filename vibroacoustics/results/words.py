"""Words of machine, options and units, kept with the results: a report needs none to be there."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.units import UNITS
from ..levels.agreement import priors_of
from ..machine.source import CaseKey
from ..mechanics.loads import Loads
from ..sources.cases import sources_of
from ..study.study import Study

_RIGID_UNDER_BODIES: Final = (
    "Bodies that an option attaches act at the rigid motion of the housing; the elastic modes of "
    "the shell do not move them."
)


def words(
    study: Study, loads: Mapping[CaseKey, Mapping[str, Loads]], results: xr.Dataset
) -> dict[str, Any]:
    """Return the words of machine and options, as JSON values."""
    inner_sources = bool(study.sources)
    options = study.options.items()
    left_out = [
        *study.machine.leaves_out(inner_sources),
        *(text for _, option in options for text in option.leaves_out(inner_sources)),
    ]
    if study.drives_shell and "option_natural_frequency" in results:
        left_out.append(_RIGID_UNDER_BODIES)
    return {
        "axes": study.machine.axes,
        "orders": study.machine.orders,
        "leaves_out": list(dict.fromkeys(left_out)),
        "labels": _labels(study, results),
        "shell_bends": study.drives_shell,
        "units": {suffix: UNITS[suffix].symbol for suffix in UNITS.origins()},
        "source_figures": _source_figures(loads),
        "priors": {prior.name: prior.words for prior in priors_of(study.machine.remainder)},
        "sources": {
            name: source.label for name, source in sources_of(study).items() if source.label
        },
        "sentences": {
            name: list(option.sentences(_figures(results, name))) for name, option in options
        },
    }


def _labels(study: Study, results: xr.Dataset) -> dict[str, str]:
    """Words for figures; those of an option must not be about what others call otherwise."""
    reported = [(option, _figures(results, name)) for name, option in study.options.items()]
    labels = dict(study.machine.labels)
    for option in study.options.values():
        others = [entry for entry in reported if entry[0].kind != option.kind]
        labels |= {
            name: text
            for name, text in option.labels.items()
            if all(
                name not in figures or entry_option.labels.get(name) == text
                for entry_option, figures in others
            )
        }
    for source in study.sources.values():
        labels |= source.labels
    return labels


def _source_figures(loads: Mapping[CaseKey, Mapping[str, Loads]]) -> list[str]:
    """Names of the figures that sources report."""
    return sorted(
        {name for case in loads.values() for load in case.values() for name in load.figures}
    )


def _figures(results: xr.Dataset, option: str) -> dict[str, Array]:
    """Reported figures of an option, each over the speeds at which it has one."""
    table = results["reported_figure"].sel(option=option).transpose("figure", "speed")
    return {
        str(name): row[np.isfinite(row)]
        for name, row in zip(table["figure"].values, table.values, strict=True)
        if np.isfinite(row).any()
    }
