"""Every script of `benchmarks/` runs in its quick form, or names what is not installed."""

import runpy
import sys
from pathlib import Path

import pytest
from support import ROOT

SCRIPTS = sorted(file for file in (ROOT / "benchmarks").glob("*.py") if file.stem != "quick")


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda file: file.stem)
def test_a_benchmark_runs_quickly(
    script: Path,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capfd: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(sys, "argv", [str(script), "--quick"])
    monkeypatch.syspath_prepend(str(script.parent))
    code = 0
    try:
        runpy.run_path(str(script), run_name="__main__")
    except SystemExit as left:
        code = left.code or 0
    out, err = capfd.readouterr()
    if code == 2:
        assert f"{script.name}: not installed: " in err
        assert err.count("\n") == 1
    else:
        assert code == 0, err
        assert out.strip()
    assert list(tmp_path.glob("*")) in ([], [tmp_path / "cache"])
