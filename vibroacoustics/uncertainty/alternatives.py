"""Alternatives to a study: less evidence, another prior, no discrepancy, regimes of its values.

An alternative is the study with one input changed. Nothing is computed anew: each sample counts by
its prior density and likelihood with this input, relative to those with which it was chosen
(weighted importance sampling: Hesterberg 1995, Technometrics 37, 185).
"""

from collections.abc import Iterator
from typing import Any, Final, NamedTuple

from ..levels.declared_level import Published, published_of
from ..study.regimes import regimes_of
from ..study.study import Study

LEVEL_ALONE: Final = "level alone"
WITHOUT_LEVEL: Final = "without the level"
WITHOUT_SPECTRUM: Final = "without the spectrum"
OTHER_PRIOR: Final = "other prior"
NO_DISCREPANCY: Final = "no discrepancy"
_NO_DEVIATION: Final = dict.fromkeys(
    (f"{name}_deviation_db" for name in ("path", "source", "band", "added")), 0.0
)
_ANY_LEVEL_DB: Final = 1e6
"""Standard deviation of a published level that does not count."""


class Alternative(NamedTuple):
    """A study with one input changed.

    Attributes
    ----------
    name : in the results; words where it is that of a regime
    study : with the input changed
    published : data, and the prior of the unmodelled noise alone with which samples count
    """

    name: str
    study: Study
    published: Published


def alternatives_of(study: Study) -> list[Alternative]:
    """Return the alternatives to all data with the first prior that a study has."""
    named = [*_less_evidence(study), *_no_discrepancy(study), *regimes_of(study)]
    alternatives = [Alternative(name, other, _with_first_prior(other)) for name, other in named]
    every = published_of(study)
    others = [every._replace(priors=(prior,)) for prior in every.priors[1:]]
    return alternatives + [Alternative(OTHER_PRIOR, study, other) for other in others]


def _with_first_prior(study: Study) -> Published:
    published = published_of(study)
    return published._replace(priors=published.priors[:1])


def _less_evidence(study: Study) -> Iterator[tuple[str, Study]]:
    """Names and studies without some of the published and measured data."""
    noise, spectrum = study.machine.overall_noise, study.evidence.spectrum
    if noise is None:
        return
    no_spectrum = {"evidence": study.evidence.model_copy(update={"spectrum": None})}
    if noise.spectral_share is not None or spectrum is not None:
        yield LEVEL_ALONE, _with_noise(study, spectral_share=None).model_copy(update=no_spectrum)
    if noise.spectral_share is not None and spectrum is not None:
        yield WITHOUT_SPECTRUM, study.model_copy(update=no_spectrum)
    yield WITHOUT_LEVEL, _with_noise(study, deviation_db=_ANY_LEVEL_DB)


def _with_noise(study: Study, **values: Any) -> Study:
    noise = study.machine.overall_noise
    changed = None if noise is None else noise.model_copy(update=values)
    machine = study.machine.model_copy(update={"overall_noise": changed})
    return study.model_copy(update={"machine": machine})


def _no_discrepancy(study: Study) -> Iterator[tuple[str, Study]]:
    exact = study.uncertainty.model_copy(update=_NO_DEVIATION)
    if exact != study.uncertainty:
        yield NO_DISCREPANCY, study.model_copy(update={"uncertainty": exact})
