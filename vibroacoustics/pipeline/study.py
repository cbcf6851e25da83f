"""The main job, from the machine to the scores.

study -> moving parts -> orders -> transfer -> radiation -> levels -> scores, one dataset.
"""

import xarray as xr

from .. import scoring
from ..base.errors import ParameterError
from ..base.hashing import canonical_json
from ..base.linear_algebra import one_thread_of_linear_algebra
from ..base.progress import Progress, no_progress, stage
from ..base.vocabulary import check, label_coordinates
from ..radiation.given import Radiation
from ..results import provenance
from ..results.words import words
from ..stopping.labelled import stopping_variables
from ..study.study import Study
from ..transfer import on_mounts
from ..transfer.natural_frequencies import natural_variables
from .calibration import shell_test
from .floor import on_measured_floor
from .force_sound import force_radiation, measured_force_sound
from .in_room import sound_in_room
from .motion import motion_of
from .radiating import line_difference, radiated_by, sound_field, transfer_vectors
from .shell import shell_path
from .sound import levels_of
from .structure_borne import structure_borne_sound


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
    try:
        # What is large runs in threads of its own; two of linear algebra would wait in busy loops.
        with one_thread_of_linear_algebra():
            return _run(study, progress, radiation)
    except ParameterError as error:
        raise ParameterError(f"{study.source_file}: {error}") from None


def _run(study: Study, progress: Progress, radiation: Radiation) -> xr.Dataset:
    study = on_measured_floor(study)
    motion = motion_of(study, progress)
    with stage(progress, "modes of the shell"):
        path = shell_path(study)
    test = shell_test(study, path)
    by_force = measured_force_sound(study)
    if by_force is not None:
        radiated, was_cached = force_radiation(study, by_force)
    else:
        modes = () if path is None else path.modes
        radiated, was_cached = radiated_by(radiation, study, progress, modes)
    results = motion.results.merge(radiated)
    of_any_case, highest = next(iter(motion.loads.values())), study.radiation.maximum_frequency_hz
    with stage(progress, "natural frequencies"):
        results = results.merge(natural_variables(study.machine, path, of_any_case, highest))
    results = results.merge(sound_field(study, results))
    results = results.merge(line_difference(study, results))
    moved = motion.with_results(results)
    results = results.merge(levels_of(study, moved, path, progress, test, by_force))
    results = results.merge(structure_borne_sound(study, moved, results))
    in_room = sound_in_room(study, motion.with_results(results), path, progress)
    results = results.merge(in_room)
    if study.operation.stopping:
        body = on_mounts(study.machine)
        with stage(progress, "switching off"):
            results = results.merge(stopping_variables(study, study.machine, body, results, path))
    results = results.merge(scoring.study_scores(study, results))
    results.attrs = provenance.radiation_attributes(study, radiated, was_cached)
    results.attrs["words"] = canonical_json(words(study, motion.loads, results))
    results.attrs["crank_frames"] = canonical_json(
        {
            name: option.applied_to(study.machine).crank_frame._asdict()
            for name, option in study.options.items()
        }
    )
    return check(label_coordinates(results))
