"""Machine files of issue 5 as parameter objects."""

from pathlib import Path
from typing import TypeVar

from support import ROOT

from vibroacoustics.loading import _read_toml, _Reader
from vibroacoustics.parameters.base import Parameters
from vibroacoustics.validation import validated

Model = TypeVar("Model", bound=Parameters)


def load_machine(path: Path, model: type[Model]) -> Model:
    """Read a machine file in the way of `loading`, which knows the scroll only so far."""
    reader = _Reader(path, {}, sources_required=True)
    return validated(model, reader.to_si(_read_toml(path), ()), reader)


def machine_file(name: str) -> Path:
    return ROOT / "data" / "machines" / f"{name}.toml"


def changed(machine: Model, **tables: dict[str, float]) -> Model:
    """The machine with some values of its tables replaced, unchecked."""
    return machine.model_copy(
        update={name: getattr(machine, name).model_copy(update=new) for name, new in tables.items()}
    )
