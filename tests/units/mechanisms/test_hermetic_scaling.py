"""Hermetic compressor in other sizes and with sampled values: no start or tolerance has a size."""

from functools import partial

import numpy as np
import pytest
from sampled_machines import all_sampled
from support import ROOT

from vibroacoustics.base.errors import SolverError
from vibroacoustics.base.parameters import Parameters
from vibroacoustics.base.units import split_key
from vibroacoustics.mechanisms.hermetic import cycle, pin
from vibroacoustics.mechanisms.hermetic.cycle import cycle_at_speed, steady_cycle
from vibroacoustics.study.loading import load_machine
from vibroacoustics.study.samples import samples_of, with_sample

RATIO = 0.59
POWERS = {"m": 1, "kg": 3, "kg_m2": 5, "pa": 2, "pa_s": 2, "n_m_s": 5}
"""Of the length, where densities and times stay."""


def scaled(table: Parameters, ratio: float) -> Parameters:
    """All lengths times the ratio at the same densities and times."""
    changed = {}
    for name in type(table).model_fields:
        value = getattr(table, name)
        if isinstance(value, Parameters):
            changed[name] = scaled(value, ratio)
        elif isinstance(value, float):
            unit = split_key(name)[1]
            changed[name] = value * ratio ** (POWERS.get(unit.suffix, 0) if unit else 0)
    return table.model_copy(update=changed)


@pytest.mark.parametrize("case", ["II", "III"])
@pytest.mark.long
def test_a_smaller_machine_has_the_scaled_solution(case, monkeypatch):
    """Exactly where gravity scales too; its own weight is all that else tells the sizes apart."""
    machine = load_machine(ROOT / "data" / "machines" / "estupinan_hermetic.toml")
    machine = machine.model_copy(update={"case": case})
    solve = partial(cycle_at_speed.__wrapped__, speed_rpm=2980.0, steps=40)  # none is kept
    _, given = solve(machine)
    _, plain = solve(scaled(machine, RATIO))
    monkeypatch.setattr(pin, "GRAVITY", RATIO * pin.GRAVITY)
    _, exact = solve(scaled(machine, RATIO))
    clearance = machine.bearing.clearance_m
    journal = [0, 1]
    for solution, allowed in ((exact, 1e-8), (plain, 1e-2)):
        apart = solution.states[:, journal] / RATIO - given.states[:, journal]
        assert np.max(np.abs(apart)) < allowed * clearance
    np.testing.assert_allclose(exact.states[:, -1], given.states[:, -1], rtol=1e-9)


def test_thicker_oils_lead_to_the_same_cycle(monkeypatch):
    """Where the first search ends without a cycle, as it is made to here."""
    machine = load_machine(ROOT / "data" / "machines" / "estupinan_hermetic.toml")
    machine = machine.model_copy(update={"case": "II"})
    _, given = steady_cycle(machine, steps=40)
    solved, tries = cycle._solved, []

    def at_first_not(equations, mesh, guess):
        tries.append(equations.machine.bearing.viscosity_pa_s / machine.bearing.viscosity_pa_s)
        if len(tries) == 1:
            raise SolverError("none")
        return solved(equations, mesh, guess)

    monkeypatch.setattr(cycle, "_solved", at_first_not)
    _, again = steady_cycle(machine, steps=40)
    assert tries == pytest.approx([1.0, 8.0, 4.0, 2.0, 1.4, 1.0])
    size = np.abs(given.states).max(axis=0)
    np.testing.assert_allclose(again.states / size, given.states / size, atol=1e-8)


@pytest.mark.long
def test_all_of_64_sampled_machines_have_a_cycle(tmp_path, monkeypatch):
    study = all_sampled(tmp_path, monkeypatch, "estupinan_hermetic", 64)
    for sample in samples_of(study).samples:
        machine = with_sample(study.machine, study.machine, sample)
        cycle_at_speed(machine, 2980.0, 144)
