"""Run of a study with several machines: each with its report, then all of them together."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Final

import xarray as xr

from ..base.errors import ParameterError, StorageError
from ..base.progress import Progress, no_progress, stage
from ..pipeline.machines import run_machines
from ..report.analysis import Analysis
from ..report.file_names import file_name
from ..report.several_machines import analysis_of_machines
from ..results.several_machines import sound_of
from ..results.storage import open_results
from ..sound.files import at_gain, next_full_scale, wav_bytes
from ..sound.rendering import SAMPLE_RATE_HZ
from ..sound.together import rendered_together
from ..study.study import Study
from . import outputs
from .outcome import Outcome
from .printing import Printer

MACHINES_NAME: Final = "machines.nc"


def run_and_write(
    study: Study, folder: Path, progress: Progress = no_progress, printer: Printer | None = None
) -> Outcome:
    """Run a study with several machines and write the files of each, then of all together.

    Parameters
    ----------
    study : with tables `machines.NAME`
    folder : folder of the results; those of each machine go to a folder in it
    progress : called with the advance of long work
    printer : makes PDFs of the pages; None for none

    Raises
    ------
    ParameterError, SolverError, StorageError
        An input is out of range, a computation failed, the folder cannot be written.
    """
    inner = {name: folder / file_name(name) for name in study.machines}
    if len(set(inner.values())) < len(inner):
        raise ParameterError(f"{study.source_file}: machines: two names have one name of a folder")
    for each in inner.values():
        outputs.check_folder(each, outputs.RUN_FILES)
    tree = run_machines(study, progress)
    with stage(progress, "report"):
        files = {
            f"{name}/report": outputs.write_study(tree[name].to_dataset(), each, printer)[1][
                "report"
            ]
            for name, each in inner.items()
        }
        analysis = analysis_of(tree.to_dataset())
        joined = outputs.write_analysis(analysis, tree.to_dataset(), folder, MACHINES_NAME, printer)
    words = "\n".join([*study.left_out, *(f"coarse: {line}" for line in study.coarsened)])
    return Outcome(words, joined | files, analyses={"": analysis})


def analysis_of(results: xr.Dataset) -> Analysis:
    """Return the analysis of several machines together, with their sound at each receiver.

    Parameters
    ----------
    results : root of the tree of `run_machines`
    """
    sounds = {name: sound_of(results, name) for name in map(str, results["common_receiver"].values)}
    speeds = results["machine_speed"].values.tolist()
    pressures = {name: rendered_together(sound, speeds) for name, sound in sounds.items()}
    scale = next_full_scale(max(float(abs(each).max()) for each in pressures.values()))
    names = {name: f"together_{file_name(name)}_{scale:g}Pa.wav" for name in pressures}
    contents = {
        names[name]: wav_bytes(at_gain(each, scale), SAMPLE_RATE_HZ, scale)
        for name, each in pressures.items()
    }
    return replace(analysis_of_machines(results, names), further=contents)


def open_machines(folder: str | Path) -> xr.DataTree:
    """Read what a run of several machines wrote: a tree, as `run_machines` gives it.

    Each node is a file with its hash: `machines.nc` at the root, `results.nc` of each machine in
    its folder.

    Parameters
    ----------
    folder : folder of the results

    Raises
    ------
    StorageError
        A file is missing, damaged, or of something else.

    Examples
    --------
    >>> va.open_machines("reports/nothing")
    Traceback (most recent call last):
        ...
    vibroacoustics.base.errors.StorageError: reports/nothing/machines.nc: ...
    """
    root = open_results(Path(folder) / MACHINES_NAME)
    if "machine_speed" not in root:
        raise StorageError(f"{folder}: holds no run of several machines")
    return xr.DataTree.from_dict({"/": root, **dict(_nodes(root, Path(folder)))})


def _nodes(root: xr.Dataset, folder: Path) -> Iterator[tuple[str, xr.Dataset]]:
    for name in map(str, root["machine"].values):
        yield name, open_results(folder / file_name(name) / outputs.RESULTS_NAME)
