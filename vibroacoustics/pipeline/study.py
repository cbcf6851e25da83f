"""The main job: the stages of a study, each after those that give what it reads."""

from functools import partial

import xarray as xr

from ..base.fault import collected
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.plain_bytes import canonical_json
from ..base.progress import Progress, no_progress
from ..base.vocabulary import check, label_coordinates
from ..machine.cases import Cases
from ..measured.floor_functions import on_measured_floor
from ..radiation.given import Radiation
from ..results import provenance
from ..results.left_out import keep_lines
from ..results.words import words
from ..stages.chain import Chain
from ..stages.radiation import Radiated, transfer_vectors
from ..stages.stage import STAGES, advanced, applying, needed_for
from ..study.failing import surviving
from ..study.study import Study


def run(
    study: Study,
    progress: Progress = no_progress,
    radiation: Radiation = transfer_vectors,
) -> xr.Dataset:
    """Carry a study from the machine's parameters to the scores of its options.

    Parameters
    ----------
    study : from `load_study`
    progress : called with the advance of long work
    radiation : gives the transfer vectors: the package's, measured ones or a second method's

    Returns
    -------
    one dataset with all variables of `vocabulary.VARIABLES`

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, a file cannot be read.

    Examples
    --------
    Without `radiation` the package computes it: some minutes once, then seconds.

    >>> study = va.load_study("pipelines/copeland_thesis.toml")
    >>> study = study.replace({"operation.speed_rpm": [2900.0]})
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers), 6, 1))  # made up, Pa s/m
    >>> results = va.run(study, radiation=va.given_radiation(vectors, frequency))
    >>> results["force_amplitude"].sel(option="none", order=1).round(1).values  # N
    array([45.3])
    """
    return carried(study, progress, radiation)[0]


def carried(study: Study, progress: Progress, radiation: Radiation) -> tuple[xr.Dataset, Chain]:
    """Run a study as `run` does; return its results and the chain with what is not stored."""
    # What is large runs in threads of its own; two of linear algebra would wait in busy loops.
    with one_thread_of_linear_algebra(), collected() as lines:
        results, chain = surviving(study, partial(_run, progress=progress, radiation=radiation))
        return keep_lines(results, (*study.left_out, *lines)), chain


def chain_with(
    study: Study,
    product: type,
    progress: Progress = no_progress,
    radiation: Radiation = transfer_vectors,
) -> Chain:
    """Carry a study through the stages that a product follows from, and the one that gives it.

    Parameters
    ----------
    study : from `load_study`
    product : type of what a stage hands on
    progress : called with the advance of long work
    radiation : gives the transfer vectors
    """
    with one_thread_of_linear_algebra():
        chain = Chain(study, radiation, progress)
        for stage in needed_for(product, applying(study)):
            chain = advanced(chain, stage)
    return chain


def _run(study: Study, progress: Progress, radiation: Radiation) -> tuple[xr.Dataset, Chain]:
    study = on_measured_floor(study)
    chain = Chain(study, radiation, progress)
    for stage in applying(study):
        with STAGES.spared():
            chain = advanced(chain, stage)
    results, radiated = chain.results, chain[Radiated]
    results.attrs = provenance.radiation_attributes(study, radiated.attributes, radiated.was_cached)
    results.attrs["words"] = canonical_json(words(study, chain[Cases].loads, results))
    frames = {
        name: option.applied_to(study.machine).crank_frame._asdict()
        for name, option in study.options.items()
    }
    results.attrs["crank_frames"] = canonical_json(frames)
    return check(label_coordinates(results)), chain
