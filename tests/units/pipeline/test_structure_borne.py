"""Structure-borne sound of a study: told apart from that by air, and given nothing, nothing."""

import numpy as np
import pytest
from pages import page_of
from support import ROOT, TINY, command_here, made_up_radiation

import vibroacoustics as va
from vibroacoustics.base.decibel import energy_sum
from vibroacoustics.mechanics.loads import Loads, Tone
from vibroacoustics.mechanics.ports import HOUSING
from vibroacoustics.report.blocks import Part
from vibroacoustics.report.sections import SECTIONS
from vibroacoustics.report.sections.structure_borne import (
    both_paths_table,
    carrier,
    dominant_path_sentence,
)
from vibroacoustics.sources.cases import cases_of
from vibroacoustics.study.selection import at_speeds
from vibroacoustics.transfer import on_mounts
from vibroacoustics.transfer.foot_figures import force_at_lines
from vibroacoustics.transfer.plate.driven import Plate, near_power

SHEET = {
    "thickness_mm": 1.0,
    "density_kg_per_m3": 7850.0,
    "youngs_modulus_gpa": 210.0,
    "loss_factor_ratio": {"value": 0.01, "source": "assumed: steel sheet", "range": [0.003, 0.03]},
}
PANEL = {**SHEET, "length_mm": 600.0, "width_mm": 500.0, "absorption_area_m2": 10.0}


def run(study, **changes):
    return va.run(study.replace(changes) if changes else study, radiation=made_up_radiation)


@pytest.fixture(scope="module")
def study():
    return va.load_study(TINY)


@pytest.fixture(scope="module")
def panel(study):
    return run(study, structure_borne=PANEL)


def test_nothing_given_is_nothing_computed(study):
    results = run(study)
    assert not [name for name in results.data_vars if "structure_borne" in str(name)]
    assert not SECTIONS["structure-borne"].applies(results)


def test_sheet_without_end_radiates_its_near_field(study):
    results = run(study, structure_borne=SHEET)
    at = results.sel(option="none").isel(speed=0)
    force = at["foot_force_order"].sum("source").sel(axis="z").transpose("order", "foot").values
    frequency = at["order_frequency"].values[1:]
    settings = study.replace({"structure_borne": SHEET}).structure_borne
    sheet = Plate(settings.mass_kg_per_m2, settings.bending_stiffness_n_m, 0.01)
    feet = results["foot_position"].values
    expected = near_power(sheet, frequency, force[1:], feet)
    given = at["structure_borne_power"].values
    np.testing.assert_allclose(given[1:], expected, rtol=1e-9, atol=1e-30)
    assert given[0] == 0.0
    spread = at["structure_borne_line_high"] - at["structure_borne_line_low"]
    np.testing.assert_allclose(spread, 2.0 * 8.224, atol=1e-2)  # no modes: 5 dB alone
    distance = np.linalg.norm([1.0825, 0.24])
    level = 10.0 * np.log10(expected[0] * 411.6 / (2.0 * np.pi * distance**2) / 4e-10)
    by_plate = at["structure_borne_line_level"].sel(weighting="Z", line="order 1").item()
    assert by_plate == pytest.approx(level, abs=1e-6)


def test_mounts_stand_on_the_plate(study, panel):
    """Feet push less on a sheet that gives way: mounts of 50 N/mm in series with its mobility.

    Up and down by the sheet's own receptance the same as a machine's table of mobilities.
    """
    rigid = run(study)["foot_force_order"]
    soft = panel["foot_force_order"]
    table = va.load_study(TINY).replace({"structure_borne": PANEL}).machine.floor_mobility
    other = study.model_copy(update={
        "machine": study.machine.model_copy(update={"floor_mobility": table})})  # fmt: skip
    np.testing.assert_allclose(run(other)["foot_force_order"], soft, rtol=1e-12)
    assert abs(soft - rigid).max() > 0.1 * abs(rigid).max()


def test_floor_of_the_machine_is_not_replaced(study, tmp_path):
    given = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
    machine = tmp_path / "machine.toml"
    machine.write_text(
        f"{given}\n[floor]\n"
        'mass_kg = { value = 0.0, source = "made up" }\n'
        'stiffness_n_per_mm = { value = 400.0, source = "made up" }\n'
        'loss_factor_ratio = { value = 0.05, source = "made up" }\n'
    )
    results = run(study, **{"machine.file": str(machine), "structure_borne": PANEL})
    at = results.sel(option="none", line="order 1").isel(speed=0)
    force = at["foot_force_order"].sel(axis="z", order=1).sum("source").values
    omega = 2.0 * np.pi * 2900.0 / 60.0
    expected = 0.5 * np.sum(np.abs(force) ** 2) * omega * 0.05 / (4e5 * (1.0 + 0.05**2))
    assert at["structure_borne_input_power"].item() == pytest.approx(expected, rel=1e-9)


def test_levels_add_up_and_stay_apart(panel):
    lines = panel["structure_borne_line_level"].sel(weighting="A").values
    np.testing.assert_allclose(
        energy_sum(lines, axis=-1), panel["structure_borne_level"].sel(weighting="A"), rtol=1e-12
    )
    both = np.stack([panel["level_total"], panel["structure_borne_level"].sel(weighting="A")])
    np.testing.assert_allclose(panel["level_both_ways"], energy_sum(both, axis=0), rtol=1e-12)
    low, high = (panel[f"structure_borne_level_{end}"].values for end in ("low", "high"))
    assert np.all(high - low > 2.0 * 8.2)  # with the spread of few modes


def test_tones_of_sources_push_the_feet_too(study):
    """A tone's force up and down on the machine comes down through its feet, as by itself."""
    (case,) = cases_of(at_speeds(study, [2900.0], {"none": study.options["none"]}), _quiet).values()
    rigid = np.array([0.0, 0.0, 30.0, 0.0, 0.0, 0.0], dtype=complex)
    tone = Tone("hum", 100.0, {HOUSING: rigid})
    names = ["order 0", "order 1", "elsewhere", "motor: hum"]
    force = force_at_lines(case, {"motor": Loads(tones=(tone,))}, {}, names)
    expected = on_mounts(case.machine).response(rigid, 100.0).foot_force
    np.testing.assert_allclose(force[3], expected, rtol=1e-12)
    assert not force[:3].any()
    assert abs(expected[:, 2]).min() > 0.1


def _quiet(*_):
    pass


def test_report_says_which_way_carries(panel):
    sentence = dominant_path_sentence(panel, "front_1m")
    assert "structure-borne sound dominates" in sentence or "it is uncertain" in sentence
    assert "The lowest structure-borne 1× is that of counterweight-half" in sentence
    table = both_paths_table(panel, "front_1m")
    assert [row[0] for row in table.rows] == ["none", "counterweight-half"]
    section = SECTIONS["structure-borne"]
    assert section.applies(panel)
    page = page_of(Part("s", section.title, tuple(section.blocks(panel))))
    assert b"Structure-borne sound" in page.html()
    assert [carrier(*ends) for ends in ((1, 2, 3), (4, 2, 3), (2, 1, 3))] == [
        "structure-borne sound", "airborne sound", "uncertain",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        (
            "thickness_mm",
            0.01,
            "structure_borne.thickness_mm = 0.01 mm: out of range; allowed from",
        ),
        (
            "loss_factor_ratio",
            2.0,
            "structure_borne.loss_factor_ratio = 2.0: out of range; allowed",
        ),
        ("length_mm", 600.0, "structure_borne: length_mm, width_mm: give both"),
        ("absorption_area_m2", 0.0, "structure_borne.absorption_area_m2 = 0.0 m²: out of range"),
    ],
)
def test_what_is_wrong_is_one_line(tmp_path, key, value, words):
    text = TINY.read_text().replace("../../data", str(ROOT / "data"))
    table = {**SHEET, "loss_factor_ratio": 0.01, key: value}
    file = tmp_path / "study.toml"
    file.write_text(
        text + "[structure_borne]\n" + "".join(f"{k} = {v}\n" for k, v in table.items())
    )
    outcome = command_here("check", file)
    assert outcome.returncode == 2
    assert words in outcome.stderr
    assert len(outcome.stderr.splitlines()) == 1
