"""Several machines in one study: each runs as an ordinary study, then all sound together."""

import xarray as xr

from ..base.progress import Progress, no_progress, stage
from ..machine.cases import Cases
from ..radiation.given import Radiation
from ..results.several_machines import results_together
from ..sound.on_base_frame import MachineRun
from ..stages.radiation import transfer_vectors
from ..stages.representative import Representative
from ..study.machine_studies import machine_studies
from ..study.study import Study
from ..transfer.contributions import Transmission
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
    >>> study = va.load_study("pipelines/two_compressors.toml").replace({"sources": None})
    >>> vectors = np.ones((len(study.receivers) + 2, 6, 2))  # made up, Pa s/m
    >>> radiation = va.given_radiation(vectors, [25.0, 4000.0])
    >>> list(va.run_machines(study, radiation=radiation).children)
    ['west', 'east']
    """
    studies = machine_studies(study)
    runs = {name: _run(study, name, each, progress, radiation) for name, each in studies.items()}
    tree = {"/": results_together(study, runs)}
    return xr.DataTree.from_dict(tree | {name: run.results for name, run in runs.items()})


def _run(
    study: Study, name: str, of_machine: Study, progress: Progress, radiation: Radiation
) -> MachineRun:
    with stage(progress, f"machine {name}"):
        results, chain = carried(of_machine, progress, radiation)
    chosen, machine = chain.get(Representative), study.machines[name]
    cases = chain[Cases] if chosen is None else chosen.cases
    key, common = (machine.speed_rpm, machine.option), tuple(study.common_receivers)
    return MachineRun(results, key, common, chain[Transmission], cases)
