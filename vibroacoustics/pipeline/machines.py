"""Several machines in one study: each runs as an ordinary study, then all sound together."""

import xarray as xr

from ..base.progress import Progress, no_progress
from ..machine.cases import Cases
from ..radiation.given import Radiation
from ..results.several_machines import results_together
from ..sound.machine_run import MachineRun
from ..stages.radiation import transfer_vectors
from ..stages.representative import Representative
from ..study.machine_studies import machine_studies
from ..study.study import Study
from ..transfer.received import Transmission
from .study import carried


def run_machines(
    study: Study, progress: Progress = no_progress, radiation: Radiation = transfer_vectors
) -> xr.DataTree:
    """Run a study with several machines, and combine their sound.

    Parameters
    ----------
    study : from `load_study`, with tables `machines.NAME`
    progress : called with the advance of long work
    radiation : gives the transfer vectors of each machine

    Returns
    -------
    levels, lines and beats of all machines at the root, the results of each below, by its name

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, a file cannot be read.

    Examples
    --------
    >>> study = va.load_study("pipelines/copeland_thesis.toml").replace({
    ...     "machines.west": {"position_mm": [-200.0, 0.0], "speed_rpm": 2900.0},
    ...     "machines.east": {"position_mm": [200.0, 0.0], "speed_rpm": 2880.0},
    ...     "common_receivers.front": {"x_mm": 0.0, "y_mm": 1000.0, "height_mm": 230.0}})
    >>> frequency = np.arange(25.0, 2501.0, 25.0)
    >>> vectors = 1e-4j * frequency * np.ones((len(study.receivers) + 1, 6, 1))  # made up
    >>> tree = va.run_machines(study, radiation=va.given_radiation(vectors, frequency))
    >>> list(tree.children)
    ['west', 'east']
    """
    common, runs = tuple(study.common_receivers), {}
    studies = machine_studies(study)
    for number, (name, of_machine) in enumerate(studies.items()):
        progress("machines", number, len(studies))
        results, chain = carried(of_machine, progress, radiation)
        chosen, machine = chain.get(Representative), study.machines[name]
        key = machine.speed_rpm, machine.option
        cases = chain[Cases] if chosen is None else chosen.cases
        runs[name] = MachineRun(results, key, common, chain[Transmission], cases)
    progress("machines", len(studies), len(studies))
    tree = {"/": results_together(study, runs)}
    return xr.DataTree.from_dict(tree | {name: run.results for name, run in runs.items()})
