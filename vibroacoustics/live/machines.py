"""Machines of a finished run, as its options leave them."""

import json
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr
from pydantic import TypeAdapter, ValidationError

from ..base.arrays import Array
from ..base.errors import ParameterError
from ..machine.machine import AnyMachine, Machine
from ..machine.option import AnyOption, Option
from ..results.stored_study import options, parameters
from ..transfer import MachineOnMounts, on_mounts


@dataclass(frozen=True)
class Machines:
    """Machines with the options of a run.

    Attributes
    ----------
    option : by name
    machine : by the name of the option
    """

    option: dict[str, Option]
    machine: dict[str, Machine]

    @cached_property
    def different(self) -> list[MachineOnMounts]:
        """Machines that stand differently."""
        return list(dict.fromkeys(map(on_mounts, self.machine.values())))

    def number(self, option: str) -> int:
        """Number of the option's machine among the different ones."""
        return self.different.index(on_mounts(self.machine[option]))

    def amplitude_factor(self, option: str, frequency_hz: Array) -> Array:
        """Return the factor of the option's insertion loss on a pressure at each frequency."""
        loss = self.option[option].insertion_loss()
        return np.ones_like(frequency_hz) if loss is None else loss.amplitude_factor(frequency_hz)


def machines_of(results: xr.Dataset) -> Machines | None:
    """Read them from the parameters of a run; none of another version or a third party."""
    third_party = json.loads(results.attrs.get("plugins", "{}"))
    if any(name.startswith("kind of ") for name in third_party):
        return None  # the report is the same with and without the files of a plug-in
    kept = parameters(results)
    try:
        machine = _read(AnyMachine, kept["machine"])
        kept_options = {name: _read(AnyOption, kept["options"][name]) for name in options(results)}
        return Machines(
            kept_options,
            {name: option.built_into(machine) for name, option in kept_options.items()},
        )
    except (ValidationError, ParameterError, KeyError):
        return None


def _read(kind: Any, table: Any) -> Any:
    return TypeAdapter(kind).validate_json(json.dumps(table))
