"""From mechanism to microphone: what a compressor's moving parts do to its feet and to the ear.

The public functions take or return one `xarray.Dataset`, so that a notebook needs no files:
`load_study`, `run`, `open_results`, `score`, `write_report`; `read_recording`, `label_recording`,
`analyse_orders`, `compare`.

A file of a stranger that adds a criterion, a balancing option, a source or a kind of machine
derives from `Criterion`, `Option`, `Source` or `Machine`, gives its class to `register`, and uses
`Added`, `Case`, `Loads`, `MovingPart`, `Revolution`, `Wrench`; `load_plugin` takes it in.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .base.plugin_file import load_plugin
    from .base.registry import register
    from .comparison import compare
    from .loading import load_study
    from .measurements import label_recording, read_recording
    from .mechanics.added import Added
    from .mechanics.loads import Loads
    from .mechanics.moving_parts import MovingPart, Revolution, Wrench
    from .outputs import write_report
    from .parameters.criterion import Criterion
    from .parameters.machine import Machine
    from .parameters.option import Option
    from .parameters.source import Case, Source
    from .pipeline import analyse_orders, run
    from .scoring import score
    from .storage import open_results

__all__ = [
    "Added",
    "Case",
    "Criterion",
    "Loads",
    "Machine",
    "MovingPart",
    "Option",
    "Revolution",
    "Source",
    "Wrench",
    "analyse_orders",
    "compare",
    "label_recording",
    "load_plugin",
    "load_study",
    "open_results",
    "read_recording",
    "register",
    "run",
    "score",
    "write_report",
]

_HOME = {
    "Added": "mechanics.added",
    "Case": "parameters.source",
    "Criterion": "parameters.criterion",
    "Loads": "mechanics.loads",
    "Machine": "parameters.machine",
    "MovingPart": "mechanics.moving_parts",
    "Option": "parameters.option",
    "Revolution": "mechanics.moving_parts",
    "Source": "parameters.source",
    "Wrench": "mechanics.moving_parts",
    "analyse_orders": "pipeline",
    "compare": "comparison",
    "label_recording": "measurements",
    "load_plugin": "base.plugin_file",
    "load_study": "loading",
    "open_results": "storage",
    "read_recording": "measurements",
    "register": "base.registry",
    "run": "pipeline",
    "score": "scoring",
    "write_report": "outputs",
}


def __getattr__(name: str) -> Any:
    """Import a public function when it is first asked for: `--help` must not load k-Wave."""
    if name not in _HOME:
        raise AttributeError(f"module {__name__} has no attribute {name}")
    return getattr(import_module(f"{__name__}.{_HOME[name]}"), name)
