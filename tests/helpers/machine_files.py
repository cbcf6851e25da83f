"""Machine files of `data/machines` as parameter objects."""

from pathlib import Path
from typing import Any, TypeVar

from support import ROOT

from vibroacoustics.base.parameters import Parameters
from vibroacoustics.study.reader import Reader
from vibroacoustics.study.toml_files import read_toml
from vibroacoustics.study.wording import validated

Model = TypeVar("Model", bound=Parameters)


def load_machine(path: Path, model: type[Model]) -> Model:
    """Read a machine file in the way of `loading`, which knows the scroll only so far."""
    return machine_of(read_toml(path), path, model)


def machine_of(content: dict[str, Any], path: Path, model: type[Model]) -> Model:
    """The machine of a file's content, every value of which needs a source."""
    reader = Reader(path, {}, sources_required=True)
    return validated(model, reader.to_si(content, ()), reader)


def values_of(path: Path) -> dict[str, Any]:
    """Values of a machine file in SI, unchecked."""
    return Reader(path, {}, sources_required=True).to_si(read_toml(path), ())


def machine_file(name: str) -> Path:
    return ROOT / "data" / "machines" / f"{name}.toml"


def changed(machine: Model, **tables: dict[str, float]) -> Model:
    """The machine with some values of its tables replaced, unchecked."""
    return machine.model_copy(
        update={name: getattr(machine, name).model_copy(update=new) for name, new in tables.items()}
    )
