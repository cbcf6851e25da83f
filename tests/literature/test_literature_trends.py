"""Trends that makers and authors publish beside modelled sources: met, missed, not tested.

Unmodelled noise is fitted to a published level and is in none of these figures. The verdicts are
those of data/validation/trends.csv; `python tests/literature/test_literature_trends.py` writes its
figures and verdicts again.
"""

import csv
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
import xarray as xr
from kept_results import kept
from scroll_openings import GAS, OPENING, POINTS, SPEED_RPM, WRAPS, gas_at

import vibroacoustics as va
from vibroacoustics.base.weighting import a_weighting
from vibroacoustics.mechanics.rotation import uniform_crank_angle
from vibroacoustics.orders import order_spectrum
from vibroacoustics.sources.oldham_keys.rattle import contact_loss_speed_rpm, steady_key_forces
from vibroacoustics.sources.scroll_gas.cycle import scroll_gas_cycle
from vibroacoustics.sources.scroll_gas.opening import steady_opening
from vibroacoustics.sources.scroll_gas.suction import built_in_pressure_pa

ROOT = Path(__file__).resolve().parents[2]
FILE = ROOT / "data" / "validation" / "trends.csv"
MET, MISSED, NOT_TESTED = "met", "missed", "not tested"


class Finding(NamedTuple):
    """A figure of ours, one decimal, in the row's unit, and the verdict."""

    ours: float
    verdict: str


def verdict(is_met: bool) -> str:
    return MET if is_met else MISSED


def commented_rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


# --- keys ----------------------------------------------------------------------------------------


@cache
def scroll() -> va.Machine:
    return va.load_study(ROOT / "pipelines" / "copeland_sources.toml").machine


def impacts_per_revolution(moment_n_m: float, speed_rpm: float) -> float:
    machine = scroll()
    forces = steady_key_forces(
        machine.keys, machine.oldham.mass_kg, machine.kinematics.orbit_radius_m, speed_rpm,
        np.array([moment_n_m]), np.zeros(1), revolutions=4,
    )  # fmt: skip
    return float(forces.impacts_per_revolution)


def rated_moment_n_m() -> float:
    """Least moment of the gas on the scroll about its axis, at the rating point."""
    return float(scroll_gas_cycle(WRAPS, gas_at("ari"), angles()).self_rotation_moment_n_m.min())


def angles() -> np.ndarray:
    return uniform_crank_angle(720)


def light_moment_n_m() -> float:
    """Mean moment with the discharge only 2 bar above the suction of the rating point."""
    suction = 1e5 * POINTS["ari"][0]
    gas = GAS.model_copy(
        update={"suction_pressure_pa": suction, "discharge_pressure_pa": suction + 2e5}
    )
    return float(scroll_gas_cycle(WRAPS, gas, angles()).self_rotation_moment_n_m.mean())


def rattle_at_light_load() -> Finding:
    """Impacts at 2900 rpm with the moment of a light load; none at the rating point."""
    light = impacts_per_revolution(light_moment_n_m(), SPEED_RPM)
    rated = impacts_per_revolution(rated_moment_n_m(), SPEED_RPM)
    return Finding(light, verdict(rated == 0.0 and light > 0.0))


def slap_above_a_speed() -> Finding:
    """Speed above which keys leave their faces at the rating point, and whether they do."""
    machine, moment = scroll(), rated_moment_n_m()
    limit = contact_loss_speed_rpm(
        machine.keys, machine.oldham.mass_kg, machine.kinematics.orbit_radius_m, np.array([moment])
    )
    below, above = (impacts_per_revolution(moment, share * limit) for share in (0.95, 1.1))
    return Finding(float(limit), verdict(below == 0.0 and above > 0.0))


# --- gas -----------------------------------------------------------------------------------------


def least_sound_at_equal_pressures() -> Finding:
    """Step at the opening with the least A-weighted tangential force above 800 Hz, bar."""
    built_in, crank_angle = built_in_pressure_pa(WRAPS, GAS), uniform_crank_angle(4096)
    density, _ = GAS.discharge_state
    frequency = np.arange(83) * SPEED_RPM / 60.0
    weight = np.where(frequency > 800.0, 10.0 ** (a_weighting(frequency + 1e-9) / 10.0), 0.0)
    powers = {}
    for step_bar in (-8, -4, -2, -1, 0, 1, 2, 4, 8):
        discharge = built_in + 1e5 * step_bar
        scaled = density * discharge / GAS.discharge_pressure_pa
        gas = GAS.model_copy(
            update={"discharge_pressure_pa": discharge, "discharge_density_kg_per_m3": scaled}
        )
        opened = steady_opening(WRAPS, gas, OPENING, SPEED_RPM)
        force = scroll_gas_cycle(WRAPS, gas, crank_angle, opened).tangential_force_n
        powers[step_bar] = float(weight @ np.abs(order_spectrum(force, 82)) ** 2)
    least = min(powers, key=powers.__getitem__)
    rises = min(powers[-8], powers[8]) > 2.0 * powers[least]
    return Finding(float(least), verdict(abs(least) <= 2 and rises))


# --- the chain: all modelled sources, nominal values, no published level --------------------------

AROUND = ["front_1m", "left_1m", "right_1m"]
HEMISPHERE_DB = 10.0 * np.log10(2.0 * np.pi)


def modelled(name: str, changes: dict[str, object]) -> xr.Dataset:
    """Run a study without samples and without the options."""
    study = va.load_study(ROOT / "pipelines" / f"{name}.toml").replace(changes)
    plain = {"ranges": (), "options": {"none": study.options["none"]}}
    return va.run(study.model_copy(update=plain))


def scroll_run(wrap_height_mm: float = 30.0) -> xr.Dataset:
    changes = {
        "radiation.room_solver": "closed-form",
        "operation.stopping": False,
        "machine.without": ["overall_noise"],
        "machine.wraps.height_mm": wrap_height_mm,
    }
    return kept(f"trends_scroll_{wrap_height_mm:g}", lambda: modelled("copeland_sources", changes))


def around_db(results: xr.Dataset) -> np.ndarray:
    """A-weighted level by speed, energy mean over the microphones beside the machine."""
    level = results["level_modelled"].sel(weighting="A", option="none")
    here = [name for name in AROUND if name in level["receiver"]]
    power = 10.0 ** (level.sel(receiver=here) / 10.0)
    return np.asarray(10.0 * np.log10(power.mean("receiver")))


def scroll_growth() -> Finding:
    """From 2900 to 3500 rpm; 70 and 72 dB(A) are rounded, hence 1 to 3 dB."""
    slow, fast = around_db(scroll_run())
    return Finding(fast - slow, verdict(1.0 <= fast - slow <= 3.0))


def scroll_sound_power() -> Finding:
    """At 2900 rpm; scrolls of two series have 70 to 73 dB(A), rounded."""
    level = around_db(scroll_run())[0] + HEMISPHERE_DB
    return Finding(level, verdict(69.5 <= level <= 73.5))


def scroll_own_level() -> Finding:
    """At 2900 rpm and the published microphone; 56 dB(A) with a deviation of 2 dB."""
    level = scroll_run()["level_modelled"].sel(weighting="A", option="none", receiver="front_1m")
    value = float(level.sel(speed=2900.0))
    return Finding(value, verdict(abs(value - 56.0) <= 4.0))


def share_below_900_hz() -> Finding:
    """Of the A-weighted energy at the published microphone, percent."""
    bands = scroll_run()["total_band_level"].sel(option="none", receiver="front_1m", speed=2900.0)
    hertz = bands["noise_band"].values
    power = 10.0 ** ((bands.values + a_weighting(hertz)) / 10.0)
    share = 100.0 * power[hertz < 900.0].sum() / power.sum()
    return Finding(share, verdict(10.0 <= share <= 50.0))


def heat_pump_units() -> Finding:
    """Compressor in a jacket of 7.1 dB: at most two scatters above units of 8 to 12 kW."""
    rows = commented_rows(ROOT / "data" / "validation" / "heat_pump_levels.csv")
    unit = next(row for row in rows if row["capacity_from_kw"] == "8")
    level = around_db(scroll_run())[0] + HEMISPHERE_DB - 7.1
    most = float(unit["mean_dba"]) + 2.0 * float(unit["scatter_db"])
    return Finding(level, verdict(level <= most))


def level_over_size() -> Finding:
    """From wraps of 10 to 30 mm, at 2900 rpm; 70 and 73 dB(A) are rounded, hence 2 to 4 dB."""
    rise = around_db(scroll_run())[0] - around_db(scroll_run(10.0))[0]
    return Finding(rise, verdict(2.0 <= rise <= 4.0))


def reciprocating_growth() -> Finding:
    """From 3000 to 3600 rpm; seven pairs rise by 0 to 7 dB, rounded."""
    changes = {"operation.speed_rpm": [3000.0, 3600.0]}
    slow, fast = around_db(kept("trends_hermetic", lambda: modelled("estupinan_sources", changes)))
    return Finding(fast - slow, verdict(-1.0 <= fast - slow <= 8.0))


# --- the table -----------------------------------------------------------------------------------

QUICK = (rattle_at_light_load, slap_above_a_speed, least_sound_at_equal_pressures)
ONE_RUN = (scroll_growth, scroll_sound_power, scroll_own_level, share_below_900_hz, heat_pump_units)
MORE_RUNS = (level_over_size, reciprocating_growth)
FINDINGS: dict[str, Callable[[], Finding]] = {
    finding.__name__: finding for finding in (*QUICK, *ONE_RUN, *MORE_RUNS)
}


def rows() -> list[dict[str, str]]:
    return commented_rows(FILE)


@pytest.mark.filterwarnings("ignore:.*contradict themselves")
@pytest.mark.parametrize(
    "name",
    [
        *(finding.__name__ for finding in QUICK),
        *(pytest.param(finding.__name__, marks=pytest.mark.slow) for finding in ONE_RUN),
        *(pytest.param(finding.__name__, marks=pytest.mark.long) for finding in MORE_RUNS),
    ],
)
def test_finding_is_that_of_the_table(name):
    """Ours to one digit, as it is written; the verdict follows from it."""
    (row,) = [row for row in rows() if row["test"] == name]
    finding = FINDINGS[name]()
    assert finding.ours == pytest.approx(float(row["ours"]), abs=0.06)
    assert finding.verdict == row["verdict"]


def test_every_row_has_a_verdict_and_a_source():
    for row in rows():
        assert row["fact"]
        assert row["source"]
        assert row["printed"]
        assert row["remark"]
        assert row["verdict"] in {MET, MISSED, NOT_TESTED}
        assert (row["verdict"] == NOT_TESTED) == (row["ours"] == "") == (row["test"] == "")
    assert {row["test"] for row in rows()} - {""} == set(FINDINGS)


def test_the_page_has_the_verdicts():
    """Counts of docs/benchmark.md are those of the table; figures of what is missed, too."""
    page = " ".join((ROOT / "docs" / "benchmark.md").read_text(encoding="utf-8").split())
    verdicts = [row["verdict"] for row in rows()]
    met, missed, others = (verdicts.count(each) for each in (MET, MISSED, NOT_TESTED))
    assert f"{met} trends are met, {missed} missed, {others} not tested" in page
    assert all(row["ours"] in page for row in rows() if row["verdict"] == MISSED)


def write() -> None:
    """Write figures and verdicts of the table again."""
    head = [line for line in FILE.read_text(encoding="utf-8").splitlines() if line[:1] == "#"]
    found = rows()
    for row in found:
        if row["test"]:
            finding = FINDINGS[row["test"]]()
            row.update(ours=f"{finding.ours:.1f}", verdict=finding.verdict)
    with FILE.open("w", encoding="utf-8", newline="") as file:
        file.write("\n".join([*head, ""]))
        writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(found)


if __name__ == "__main__":
    write()
