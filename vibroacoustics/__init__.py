"""From mechanism to microphone: what a compressor's moving parts do to its feet and to the ear.

The public functions take or return one `xarray.Dataset`, so that a notebook needs no files:
`load_study`, `run`, `open_results`, `score`, `write_report`; `read_recording`, `label_recording`,
`analyse_orders`, `compare`.

A file of a stranger that adds a criterion, a balancing option, a source or a kind of machine
derives from `Criterion`, `Option`, `Source` or `Machine`, gives its class to `register`, and uses
`Added`, `Case`, `Loads`, `MovingPart`, `Revolution`, `Wrench`; one that adds a variable, a
coordinate or a unit makes a `Variable`, `Coordinate` or `Unit`; one that reads a format of
recordings makes a `Reader`, which gets a `Request` and gives `Recorded`. `load_plugin` takes it in.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .base.plugin_file import load_plugin
    from .base.registry import register
    from .base.units import Unit
    from .base.vocabulary import Coordinate, Variable, check, stamp
    from .commands.outputs import write_report
    from .machine.machine import Machine
    from .machine.option import Option
    from .machine.source import Case, Source
    from .mechanics.added import Added
    from .mechanics.loads import Loads
    from .mechanics.moving_parts import MovingPart, Revolution, Wrench
    from .pipeline import analyse_orders, run
    from .recordings import label_recording, read_recording
    from .recordings.reader import Reader
    from .recordings.recorded import Recorded, Request
    from .results.order_comparison import compare
    from .results.storage import open_results
    from .scoring import score
    from .study.criterion import Criterion
    from .study.loading import load_study

__all__ = [
    "Added",
    "Case",
    "Coordinate",
    "Criterion",
    "Loads",
    "Machine",
    "MovingPart",
    "Option",
    "Reader",
    "Recorded",
    "Request",
    "Revolution",
    "Source",
    "Unit",
    "Variable",
    "Wrench",
    "analyse_orders",
    "check",
    "compare",
    "label_recording",
    "load_plugin",
    "load_study",
    "open_results",
    "read_recording",
    "register",
    "run",
    "score",
    "stamp",
    "write_report",
]

_HOME = {
    "Added": "mechanics.added",
    "Case": "machine.source",
    "Coordinate": "base.vocabulary",
    "Criterion": "study.criterion",
    "Loads": "mechanics.loads",
    "Machine": "machine.machine",
    "MovingPart": "mechanics.moving_parts",
    "Option": "machine.option",
    "Reader": "recordings.reader",
    "Recorded": "recordings.recorded",
    "Request": "recordings.recorded",
    "Revolution": "mechanics.moving_parts",
    "Source": "machine.source",
    "Unit": "base.units",
    "Variable": "base.vocabulary",
    "Wrench": "mechanics.moving_parts",
    "analyse_orders": "pipeline",
    "check": "base.vocabulary",
    "compare": "results.order_comparison",
    "label_recording": "recordings",
    "load_plugin": "base.plugin_file",
    "load_study": "study.loading",
    "open_results": "results.storage",
    "read_recording": "recordings",
    "register": "base.registry",
    "run": "pipeline",
    "score": "scoring",
    "stamp": "base.vocabulary",
    "write_report": "commands.outputs",
}


def __getattr__(name: str) -> Any:
    """Import a public function when it is first asked for: `--help` must not load k-Wave."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
