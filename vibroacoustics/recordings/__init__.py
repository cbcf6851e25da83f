"""Recordings in: WAV, MAT, CSV, HDF5, netCDF, UFF 58 and TDMS as one labelled form; modes and
functions of frequency in.

The functions are imported when they are first asked for: the process that reads a file (`child`)
needs no labelled arrays.
"""

from typing import TYPE_CHECKING, Any

from ..base.lazy import imported

if TYPE_CHECKING:
    from .blocks import FileBlocks, LabelledBlocks, open_recording
    from .export import csv_bytes, wav_bytes
    from .function_export import functions_csv, functions_uff
    from .functions import read_functions
    from .measured_function import MeasuredFunction, Node
    from .modes import MeasuredModes, read_modes
    from .reading import read_recording
    from .recording import label_recording

__all__ = [
    "FileBlocks",
    "LabelledBlocks",
    "MeasuredFunction",
    "MeasuredModes",
    "Node",
    "csv_bytes",
    "functions_csv",
    "functions_uff",
    "label_recording",
    "open_recording",
    "read_functions",
    "read_modes",
    "read_recording",
    "wav_bytes",
]

_HOME = {
    "FileBlocks": "blocks",
    "LabelledBlocks": "blocks",
    "open_recording": "blocks",
    "MeasuredFunction": "measured_function",
    "MeasuredModes": "modes",
    "Node": "measured_function",
    "csv_bytes": "export",
    "functions_csv": "function_export",
    "functions_uff": "function_export",
    "label_recording": "recording",
    "read_functions": "functions",
    "read_modes": "modes",
    "read_recording": "reading",
    "wav_bytes": "export",
}


def __getattr__(name: str) -> Any:
    """Import a public function when it is first asked for."""
    return imported(__name__, _HOME, name)
