"""Values a thousand times too large or small are refused or warned of; those of the package not."""

import re
import warnings
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from support import MACHINE_FILE, PIPELINES, ROOT
from thousandfold import Mistake, mistakes, outcome, written_files, wrong_file

from vibroacoustics.mechanisms.tabulated.machine import Forces
from vibroacoustics.study.loading import load_machine, load_study_or_machine

LEAST_SEEN = 0.9
STEP = 23
"""Every so many mistakes, in the short form; no divisor of two or of ten."""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, ...]:
    return written_files(tmp_path_factory.mktemp("thousandfold"))


@pytest.mark.parametrize("step", [STEP, pytest.param(1, marks=pytest.mark.long)])
@pytest.mark.parametrize("with_range", [True, False])
def test_nine_of_ten_mistakes_are_seen(
    files: tuple[Path, ...], step: int, with_range: bool
) -> None:
    """Of a share of 0.98 or more, 90 of 100 are found in all but one of 10 000 small samples."""
    each = [one for file in files for one in mistakes(file)][::step]
    found = Counter(outcome(one, with_range) for one in each)
    assert len(each) > 2000 // step
    assert found["passed"] <= (1.0 - LEAST_SEEN) * len(each), found


def test_no_file_of_the_package_is_doubted(files: tuple[Path, ...]) -> None:
    studies = [*PIPELINES.glob("*.toml"), *(ROOT / "tests" / "studies").glob("*.toml")]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for file in (*studies, *files):
            if file.parent.name.endswith("-sources"):  # 1 of 101 samples contradicts itself
                continue
            load_study_or_machine(file)


@pytest.mark.parametrize(
    ("table", "key", "factor", "words"),
    [
        ("oldham", "mass_kg", 1e3, "oldham.mass_kg = 72.7 kg: usual is 0.0035 to 35 kg .*in g?"),
        (
            "mounts",
            "vertical_stiffness_n_per_mm",
            1e3,
            "natural frequency of 2 to 60 Hz with 35 kg",
        ),
        ("housing", "mass_kg", 10.0, "0.5 to 20 g/cm³ for the 8.92 litres of the shell"),
        ("counterweights", "radius_mm", 1e-3, "0.025 mm: usual is 0.5 to 500 mm .*in m?"),
    ],
)
def test_a_warning_tells_value_reason_and_unit(
    files: tuple[Path, ...], table: str, key: str, factor: float, words: str
) -> None:
    machine = next(file for file in files if file.name == "copeland_zp41k3e.toml")
    wrong = machine.with_name("wrong.toml")
    wrong.write_text(wrong_file(Mistake(machine, (table, key), factor), True), encoding="utf-8")
    with warnings.catch_warnings(record=True) as warned:
        warnings.simplefilter("always")
        load_study_or_machine(wrong)
    wrong.unlink()
    assert any(re.search(words, str(one.message)) for one in warned), warned


def test_forces_of_a_table_are_judged_by_mass_and_speed(
    files: tuple[Path, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As given they move 260 kg by 1.3 mm at 1200 rpm; a thousand times that is a mistake."""
    machine = next(file for file in files if file.name == "reciprocating_table.toml")
    given = Forces.orders_at
    monkeypatch.setattr(Forces, "orders_at", lambda forces, speed: 1e3 * given(forces, speed))
    with pytest.warns(UserWarning, match="order 1 of .* would move 260 kg") as warned:
        load_study_or_machine(machine)
    found = re.search(r"of (\S+) N would .* by (\S+) mm; usual is", str(warned[0].message))
    assert found is not None
    force_n, motion_mm = map(float, found.groups())
    assert motion_mm == pytest.approx(1e3 * force_n / (260.0 * (40.0 * np.pi) ** 2), rel=0.01)


def test_mounts_are_judged_by_their_natural_frequency() -> None:
    """Against a mass on springs: the ends of the range give 2 and 60 Hz."""
    machine = load_machine(MACHINE_FILE)
    usual = {one.field: one for one in machine.usual()}["mounts.vertical_stiffness_n_per_m"]
    for stiffness, hertz in ((usual.lowest, 2.0), (usual.highest, 60.0)):
        found = np.sqrt(4.0 * stiffness / machine.housing.mass_kg) / (2.0 * np.pi)
        assert found == pytest.approx(hertz)
