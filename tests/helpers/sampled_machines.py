"""Studies of every machine that sample all of its values."""

from pathlib import Path

import pytest
from support import ROOT

from vibroacoustics.sources.gas import ScrollGasForces
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.study import Study


def all_sampled(folder: Path, monkeypatch: pytest.MonkeyPatch, name: str, count: int) -> Study:
    """A study of `pipelines` with a source that asks for nothing, so that values are sampled."""
    monkeypatch.setattr(ScrollGasForces, "why_not", classmethod(lambda *_: None))
    monkeypatch.setattr(ScrollGasForces, "drives_shell", False)
    text = (ROOT / "pipelines" / f"{name}.toml").read_text(encoding="utf-8")
    further = f'\n[sources.gas]\nkind = "scroll-gas"\n[uncertainty]\nrandom_samples = {count}\n'
    (folder / "study.toml").write_text(text.replace("../data", str(ROOT / "data")) + further)
    return load_study(folder / "study.toml")
