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
    tree of datasets: levels, lines and beats of all machines at its root, the results of each run
    below, by the name of the machine

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, a file cannot be read.
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
