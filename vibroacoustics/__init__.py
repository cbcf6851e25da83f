"""From mechanism to microphone: what a compressor's moving parts do to its feet and to the ear.

    >>> import vibroacoustics as va

**Studies.**
`load_study(path)` reads a `Study`; its method `replace({...})` changes values of it.
`run(study)` carries it from the machine's parameters to levels and scores, one `xarray.Dataset`.
`radiate(study)` computes the housing's radiation alone.
`given_radiation(...)` makes measured transfer vectors what `run` takes.
`score(results)` scores and ranks the options again.
`sweep(study, {...})` computes every design of a grid or a sample of values;
`optimise(study)` searches for the best designs of its table `[design]`, which is a `Problem` for
searches of your own.
`write_report(results, folder)` writes the report with tables and figures.
`data_sheet(results, option)` makes the data sheet of an option, a `DataSheet`, predicted;
`write_data_sheet(sheet, folder)` writes it as page, CSV and JSON.
`open_results(path)` reads results from a file.
`export_forces(results, path)` writes their forces for a machine of `kind = "table"`.
`curves(study)` shows what goes on inside: pressures, films, friction, torques, critical speeds;
also of a machine alone, from `load_machine(path)`.

**Recordings.**
`read_recording(path)` reads a recording of any format.
`open_recording(path)` opens one of any length, to be read in blocks.
`label_recording(...)` labels samples as one.
`export_recording(recording, path)` writes it as CSV, WAV or netCDF.
`read_modes(path)` reads measured modes of a structure.
`read_functions(path)` reads frequency responses and spectra, each a `MeasuredFunction` between two
`Node`s; `export_functions(functions, path)` writes them as UFF or CSV.
`analyse_orders(recording, settings)` finds orders and levels; settings are an `OrderAnalysis`.
`track_orders(recording, ...)` follows orders over time (Vold-Kalman).
`sound_power(recordings, surface, ...)` gives a machine's sound power from the microphones around
it (ISO 3744), on a `MeasurementSurface`.
`speed_frequency_map(recording, ...)` gives spectra over speed and frequency (Campbell).
`compare(first, second)` compares orders of two results in level and phase.
`read_limits(path)` reads limits of orders, each a `Limit`.
`read_figure_limits(path)` reads limits of bands, totals and criteria too, each a `FigureLimit`.
`mean_of_runs(runs, specimens)` averages recordings of several runs and specimens.
`check_limits(results, limits)` holds orders of a recording, a study or a comparison against them.
`SpeedChannel`, `NominalSpeed`, `TacholessSpeed` say where the speed comes from.

**Measurements alone.**
`predict(path)` predicts levels after a change of mounts, an added mass or an absorber, with a band;
`changed_response(...)` is its formula for arrays.
`blocked_forces(path)` finds the blocked forces of a source where it stands (ISO 20270);
`inverted_forces(...)` is its formula for arrays.

**Figures and arrays.**
`plot` has every figure as a function that returns a matplotlib Figure.
`orders` and `levels` have the steps of an analysis as functions of arrays, `sound` those of
listening, tones, loudness and sharpness, `rooms` the sound of a source in a furnished room.

**Sound.**
`listen(results, folder)` writes the sound of options at microphones as WAV or FLAC;
`impulse_responses(study)` are the responses in its room to accelerations of the machine.

**Things of your own.**
`register(thing)` and `load_plugin(path)` take them in: a class derived from `Option`, `Machine`,
`Source` or `Criterion`, or a `Section` or `Column` of the report, whose content `blocks` make.
A `Stage` of a run gets the `Chain` with `Cases` and results so far, and returns what is `Given`.
`Added`, `Case`, `Loads`, `MovingPart`, `Revolution`, `Wrench`, `OldhamRing`, `Slider` are what
these get and return; `circling`, `constant_rotation` and `wrenches_of_parts` make forces of moving
masses. Further results of an option are a `RingForce`, a `FurtherRing` and an `InsertionLoss`. A
machine has a `Rotation`, a `CrankFrame`, tables of `Parameters`, and for options each `Capability`,
such as a slider with `BalancePlanes`; `Held` marks values that are not sampled. A `FileTable` takes
values from a data file, by `read_columns` from CSV.
Loads act at a `Port`: `HOUSING`, `BLOCK`, the parts `FIXED_SCROLL`, `BEARING_HOUSING`,
`ORBITING_SCROLL`, `LOWER_BEARING` and `STATOR`, the `STATOR_YOKE`, a `GasPort`; a `Tone` is a
line that is no order, `Noise` a random load. A `DesignFigure` of what is seen of designs, each a
`Need`, is what they can be judged by. A `Curve` over each `CurveAxis` shows what goes on inside. A
`Variable`, `Coordinate` or `Unit` joins the vocabulary; `stamp` labels an array as a variable,
`check` tests a dataset. A `Reader` reads a format of recordings: it gets a `Request` and gives
`Recorded`.

**Errors.** All derive from `VibroacousticsError`, each message is one line: `ParameterError`,
`SolverError`, `StorageError`, `SchemaError`, `PluginError`. Doubtful recordings are a
`RecordingWarning`, doubtful pulses of a tacho a `PulseWarning`.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from .base.lazy import imported

if TYPE_CHECKING:
    from . import levels, orders, plot, sound
    from .base.column_file import read_columns
    from .base.curves import Curve, CurveAxis
    from .base.errors import (
        ParameterError,
        PluginError,
        SchemaError,
        SolverError,
        StorageError,
        VibroacousticsError,
    )
    from .base.file_table import FileTable
    from .base.parameters import Held, Parameters
    from .base.plugin_file import load_plugin
    from .base.registry import register
    from .base.units import Unit
    from .base.vocabulary import Coordinate, Variable, check, stamp
    from .commands.exporting import export_forces, export_functions, export_recording
    from .commands.listening import listen
    from .commands.outputs import write_report
    from .commands.sheets import write_data_sheet
    from .design.engine.seen import Need
    from .design.figure import DesignFigure
    from .design.optimising import optimise
    from .design.problem import Problem
    from .design.sweep import sweep
    from .machine.cases import Cases
    from .machine.cavities import GasPort
    from .machine.frame import (
        BEARING_HOUSING,
        FIXED_SCROLL,
        LOWER_BEARING,
        ORBITING_SCROLL,
        STATOR,
    )
    from .machine.machine import Machine
    from .machine.option import Option
    from .machine.source import Case, Source
    from .machine.stator_yoke import STATOR_YOKE
    from .machine.suspension import BLOCK
    from .measured.blocked_forces import blocked_forces
    from .measured.change import changed_response
    from .measured.inversion import inverted_forces
    from .measured.measurement_surface import MeasurementSurface
    from .measured.prediction import predict
    from .measured.recorded_orders import analyse_orders, speed_frequency_map, track_orders
    from .measured.sound_power import sound_power
    from .mechanics.added import Added, FurtherRing, InsertionLoss, RingForce
    from .mechanics.capabilities import BalancePlanes, Capability, CrankFrame, OldhamRing, Slider
    from .mechanics.loads import Loads, Noise, Tone
    from .mechanics.moving_parts import (
        MovingPart,
        Revolution,
        Wrench,
        circling,
        wrenches_of_parts,
    )
    from .mechanics.ports import HOUSING, Port
    from .mechanics.rotation import Rotation, constant_rotation
    from .orders.recorded_speed import PulseWarning
    from .pipeline import impulse_responses, radiate, run
    from .radiation import rooms
    from .radiation.given import given_radiation
    from .recordings import (
        MeasuredFunction,
        Node,
        label_recording,
        open_recording,
        read_functions,
        read_modes,
        read_recording,
    )
    from .recordings.reader import Reader
    from .recordings.recorded import Recorded, Request
    from .recordings.remarks import RecordingWarning
    from .report import blocks
    from .report.columns import Column
    from .report.data_sheet.model import DataSheet
    from .report.data_sheet.sheet import data_sheet
    from .report.sections import Section
    from .results.figure_limit import FigureLimit
    from .results.limit import Limit
    from .results.limits_file import read_figure_limits, read_limits
    from .results.mean_of_runs import mean_of_runs
    from .results.order_comparison import compare
    from .results.order_limits import check_limits
    from .results.storage import open_results
    from .scoring import score
    from .sources.curves import curves
    from .stages.chain import Chain
    from .stages.stage import Given, Stage
    from .study.criterion import Criterion
    from .study.loading import load_machine, load_study
    from .study.order_analysis import NominalSpeed, OrderAnalysis, SpeedChannel, TacholessSpeed
    from .study.study import Study

__all__ = [
    "BEARING_HOUSING",
    "BLOCK",
    "FIXED_SCROLL",
    "HOUSING",
    "LOWER_BEARING",
    "ORBITING_SCROLL",
    "STATOR",
    "STATOR_YOKE",
    "Added",
    "BalancePlanes",
    "Capability",
    "Case",
    "Cases",
    "Chain",
    "Column",
    "Coordinate",
    "CrankFrame",
    "Criterion",
    "Curve",
    "CurveAxis",
    "DataSheet",
    "DesignFigure",
    "FigureLimit",
    "FileTable",
    "FurtherRing",
    "GasPort",
    "Given",
    "Held",
    "InsertionLoss",
    "Limit",
    "Loads",
    "Machine",
    "MeasuredFunction",
    "MeasurementSurface",
    "MovingPart",
    "Need",
    "Node",
    "Noise",
    "NominalSpeed",
    "OldhamRing",
    "Option",
    "OrderAnalysis",
    "ParameterError",
    "Parameters",
    "PluginError",
    "Port",
    "Problem",
    "PulseWarning",
    "Reader",
    "Recorded",
    "RecordingWarning",
    "Request",
    "Revolution",
    "RingForce",
    "Rotation",
    "SchemaError",
    "Section",
    "Slider",
    "SolverError",
    "Source",
    "SpeedChannel",
    "Stage",
    "StorageError",
    "Study",
    "TacholessSpeed",
    "Tone",
    "Unit",
    "Variable",
    "VibroacousticsError",
    "Wrench",
    "analyse_orders",
    "blocked_forces",
    "blocks",
    "changed_response",
    "check",
    "check_limits",
    "circling",
    "compare",
    "constant_rotation",
    "curves",
    "data_sheet",
    "export_forces",
    "export_functions",
    "export_recording",
    "given_radiation",
    "impulse_responses",
    "inverted_forces",
    "label_recording",
    "levels",
    "listen",
    "load_machine",
    "load_plugin",
    "load_study",
    "mean_of_runs",
    "open_recording",
    "open_results",
    "optimise",
    "orders",
    "plot",
    "predict",
    "radiate",
    "read_columns",
    "read_figure_limits",
    "read_functions",
    "read_limits",
    "read_modes",
    "read_recording",
    "register",
    "rooms",
    "run",
    "score",
    "sound",
    "sound_power",
    "speed_frequency_map",
    "stamp",
    "sweep",
    "track_orders",
    "wrenches_of_parts",
    "write_data_sheet",
    "write_report",
]

_HOME = {
    "GasPort": "machine.cavities",
    "STATOR_YOKE": "machine.stator_yoke",
    "STATOR": "machine.frame",
    "LOWER_BEARING": "machine.frame",
    "ORBITING_SCROLL": "machine.frame",
    "BEARING_HOUSING": "machine.frame",
    "FIXED_SCROLL": "machine.frame",
    "Noise": "mechanics.loads",
    "Tone": "mechanics.loads",
    "BLOCK": "machine.suspension",
    "HOUSING": "mechanics.ports",
    "Port": "mechanics.ports",
    "Added": "mechanics.added",
    "BalancePlanes": "mechanics.capabilities",
    "Capability": "mechanics.capabilities",
    "Case": "machine.source",
    "Cases": "machine.cases",
    "Chain": "stages.chain",
    "Column": "report.columns",
    "Coordinate": "base.vocabulary",
    "CrankFrame": "mechanics.capabilities",
    "Criterion": "study.criterion",
    "Curve": "base.curves",
    "CurveAxis": "base.curves",
    "DataSheet": "report.data_sheet.model",
    "DesignFigure": "design.figure",
    "FigureLimit": "results.figure_limit",
    "FileTable": "base.file_table",
    "FurtherRing": "mechanics.added",
    "Given": "stages.stage",
    "Held": "base.parameters",
    "InsertionLoss": "mechanics.added",
    "Limit": "results.limit",
    "Loads": "mechanics.loads",
    "Machine": "machine.machine",
    "MeasuredFunction": "recordings",
    "MeasurementSurface": "measured.measurement_surface",
    "MovingPart": "mechanics.moving_parts",
    "Need": "design.engine.seen",
    "Node": "recordings",
    "NominalSpeed": "study.order_analysis",
    "OldhamRing": "mechanics.capabilities",
    "Option": "machine.option",
    "Parameters": "base.parameters",
    "PulseWarning": "orders.recorded_speed",
    "Reader": "recordings.reader",
    "Recorded": "recordings.recorded",
    "RecordingWarning": "recordings.remarks",
    "Request": "recordings.recorded",
    "OrderAnalysis": "study.order_analysis",
    "ParameterError": "base.errors",
    "PluginError": "base.errors",
    "Problem": "design.problem",
    "Revolution": "mechanics.moving_parts",
    "RingForce": "mechanics.added",
    "Rotation": "mechanics.rotation",
    "SchemaError": "base.errors",
    "Section": "report.sections",
    "Slider": "mechanics.capabilities",
    "SolverError": "base.errors",
    "Source": "machine.source",
    "SpeedChannel": "study.order_analysis",
    "Stage": "stages.stage",
    "StorageError": "base.errors",
    "Study": "study.study",
    "TacholessSpeed": "study.order_analysis",
    "Unit": "base.units",
    "Variable": "base.vocabulary",
    "VibroacousticsError": "base.errors",
    "Wrench": "mechanics.moving_parts",
    "analyse_orders": "measured.recorded_orders",
    "blocked_forces": "measured.blocked_forces",
    "changed_response": "measured.change",
    "check": "base.vocabulary",
    "check_limits": "results.order_limits",
    "circling": "mechanics.moving_parts",
    "compare": "results.order_comparison",
    "constant_rotation": "mechanics.rotation",
    "curves": "sources.curves",
    "data_sheet": "report.data_sheet.sheet",
    "export_forces": "commands.exporting",
    "export_functions": "commands.exporting",
    "export_recording": "commands.exporting",
    "given_radiation": "radiation.given",
    "impulse_responses": "pipeline",
    "inverted_forces": "measured.inversion",
    "label_recording": "recordings",
    "listen": "commands.listening",
    "open_recording": "recordings",
    "load_machine": "study.loading",
    "load_plugin": "base.plugin_file",
    "load_study": "study.loading",
    "mean_of_runs": "results.mean_of_runs",
    "open_results": "results.storage",
    "optimise": "design.optimising",
    "predict": "measured.prediction",
    "radiate": "pipeline",
    "read_columns": "base.column_file",
    "read_functions": "recordings",
    "read_figure_limits": "results.limits_file",
    "read_limits": "results.limits_file",
    "read_modes": "recordings",
    "read_recording": "recordings",
    "register": "base.registry",
    "run": "pipeline",
    "score": "scoring",
    "sound_power": "measured.sound_power",
    "speed_frequency_map": "measured.recorded_orders",
    "stamp": "base.vocabulary",
    "sweep": "design.sweep",
    "track_orders": "measured.recorded_orders",
    "wrenches_of_parts": "mechanics.moving_parts",
    "write_data_sheet": "commands.sheets",
    "write_report": "commands.outputs",
}
_MODULES = {
    "blocks": "report.blocks",
    "levels": "levels",
    "orders": "orders",
    "plot": "plot",
    "rooms": "radiation.rooms",
    "sound": "sound",
}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for: `--help` must not load k-Wave."""
    if name in _MODULES:
        return import_module(f"{__name__}.{_MODULES[name]}")
    return imported(__name__, _HOME, name)


def __dir__() -> list[str]:
    """The public names, loaded or not."""
    return __all__
