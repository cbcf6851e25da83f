"""The slider-link machine and its study, also with changed values."""

import tempfile
from pathlib import Path

import numpy as np
from support import PIPELINES, ROOT

from vibroacoustics.mechanisms.slider_link.machine import SliderLinkMachine
from vibroacoustics.study.loading import load_study

MACHINE_FILE = ROOT / "data" / "machines" / "dagilis_slider_link.toml"
STUDY = PIPELINES / "dagilis_slider_link.toml"
SPEED = 2.0 * np.pi * 2950.0 / 60.0


def changed_machine(**change: float) -> SliderLinkMachine:
    """The machine with values that a study overrides: section__key = value in the key's unit."""
    lines = [f'extends = "{STUDY}"']
    for key, value in change.items():
        *tables, name = key.split("__")
        table = ".".join(("machine", "override", *tables))
        lines.append(f'{table}.{name} = {{ value = {value}, source = "a test" }}')
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "changed.toml"
        file.write_text("\n".join(lines), encoding="utf-8")
        machine = load_study(file).machine
    assert isinstance(machine, SliderLinkMachine)
    return machine
