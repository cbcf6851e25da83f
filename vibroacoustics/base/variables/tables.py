"""Registration of the variables and coordinates in the tables beside this file."""

import tomllib
from importlib import resources

from ..registry import register
from ..vocabulary import Coordinate, Variable

for _file in resources.files(__package__).iterdir():
    if _file.name.endswith(".toml"):
        _tables = tomllib.loads(_file.read_text("utf-8"))
        for _kind, _table in (("coordinate", Coordinate), ("variable", Variable)):
            for _name, _entry in _tables.get(_kind, {}).items():
                _tuples = {_key: tuple(_entry[_key]) for _key in {"dims", "bounds"} & _entry.keys()}
                _labelled = register(_table(_name, **{**_entry, **_tuples}))
                if isinstance(_labelled, Variable):
                    for _beside in _labelled.of_samples():
                        register(_beside)
