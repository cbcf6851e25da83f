"""Inner curves of every kind of machine and source: by the verb, and on disk by the command."""

import csv
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from inner_curves import FILES, inner
from machine_files import machine_file
from support import PIPELINES, ROOT, assert_refused, command_here

import vibroacoustics as va
from vibroacoustics.base.curves import shown
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.machine.machine import MACHINES, Machine
from vibroacoustics.report.charts.marks import Bars, Line
from vibroacoustics.report.figures.curves import curves as chart_of
from vibroacoustics.sources.gas import ScrollGasForces
from vibroacoustics.sources.keys import OldhamKeyForces
from vibroacoustics.sources.scroll_gas.opening import REPEATED

ZHAO = machine_file("zhao_minicrank")
PORT = "port, chamber to plenum"
ANNOUNCED = {
    "copeland_sources": (
        "pocket_pressure", "gas_force", "gas_force_angle", "key_force", "whirl_frequency",
        "critical_speed", "ring_force",
    ),
    "mayekawa_wbhe": (
        "crank_speed", "friction_torque", "friction_loss", "mechanical_efficiency", "best_design",
    ),
    "zhao_minicrank": ("external_force", "ideal_input_torque", "input_torque_by_error"),
    "dagilis_slider_link": ("friction_moment", "friction_force", "friction_coefficient"),
    "estupinan_hermetic": (
        "joint_force", "crank_reaction_moment", "upper_bearing_force", "journal_orbit",
        "highest_film_pressure", "thinnest_film", "whirl_frequency",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_curves_are_finite_and_say_what_they_are(name):
    curves = inner(name)
    assert set(ANNOUNCED[name]) <= set(curves.data_vars)
    for curve in curves.values():
        assert np.all(np.isfinite(curve.values))
        assert curve.attrs["units"]
        assert curve.attrs["title"]
        assert curve.attrs["source"]
        for dim in curve.dims:
            assert curve[dim].attrs["long_name"]
    assert curves.attrs["speed_rpm"] > 0.0


def test_opening_with_inertia_has_curves_of_its_own():
    """They pass from one to the other: pocket from its compression, the chamber as it began."""
    curves = va.curves(va.load_study(PIPELINES / "copeland_sources.toml"))
    pressure, flow = curves["opening_pressure"], curves["opening_flow"]
    pocket, chamber = pressure.sel(volume="opened pocket"), pressure.sel(volume="chamber inside")
    opening = np.argmin(abs(curves["pocket_pressure"]["pocket_angle"].values - np.radians(480.0)))
    assert float(pocket[0]) == pytest.approx(float(curves["pocket_pressure"][opening]), rel=0.01)
    assert float(chamber[-1]) == pytest.approx(float(chamber[0]), rel=REPEATED)
    assert abs(flow.sel(passage="gap, pockets to chamber").values[[0, -1]]).max() == 0.0
    assert float(flow.sel(passage="port, chamber to plenum").mean()) == pytest.approx(
        0.068, rel=0.02
    )
    for name in ("opening_pressure", "opening_flow"):
        (*_, panel) = chart_of(curves, name).panels
        assert "Crank angle since a pocket has opened" in panel.x.label


def test_suction_and_discharge_line_of_a_scroll_with_inertia():
    """The pockets take the displacement; the tube pulsates as the plenum, less behind a chamber."""
    curves = va.curves(va.load_study(PIPELINES / "copeland_sources.toml"))
    leak = curves["leak_flow"]
    first_turn = leak.values[leak["contact_angle"].values < 2.0 * np.pi]
    lost = float(first_turn.mean()) / float(curves["opening_flow"].sel(passage=PORT).mean())
    assert lost == pytest.approx(0.033, abs=0.004)  # back to suction, of what is delivered
    taken = float(curves["suction_flow"].mean()) / 33.0 * 60.0 / 2900.0
    assert taken == pytest.approx(1.03 * 39.66e-6, rel=0.04)
    plenum = curves["opening_pressure"].sel(volume="plenum").values
    at_shell, behind = curves["tube_pressure"].values
    np.testing.assert_allclose(at_shell, plenum - plenum[:-1].mean(), atol=0.02 * np.ptp(plenum))
    assert 0.2 < np.ptp(behind) / np.ptp(at_shell) < 0.8
    m = (50.0 / 10.7) ** 2
    most = 10.0 * np.log10(1.0 + 0.25 * (m - 1.0 / m) ** 2)
    assert float(curves["muffler_loss"].max()) == pytest.approx(most, abs=0.01)


@pytest.mark.parametrize("name", FILES)
def test_every_curve_has_a_picture_with_labels(name):
    curves = inner(name)
    for variable in curves.data_vars:
        drawn = chart_of(curves, str(variable))
        assert drawn.panels[-1].x.label  # which those above share
        assert all(panel.y.label or panel.y.ticks for panel in drawn.panels)
        assert curves[variable].attrs["title"][:20] in drawn.title
        marks = [mark for panel in drawn.panels for mark in panel.marks]
        values = [
            m.size if isinstance(m, Bars) else m.y for m in marks if isinstance(m, Bars | Line)
        ]
        if curves[variable].attrs["picture"] != "orbit":
            in_chart = np.concatenate(values)[: curves[variable].size]
            np.testing.assert_array_equal(in_chart, shown(curves[variable]).ravel())


def test_every_built_in_kind_has_curves():
    assert len(MACHINES) >= 5
    built_in = [kind for name, kind in MACHINES.items() if MACHINES.origin(name) is None]
    built_in.remove(MACHINES["table"])  # of which nothing inside is known
    assert all(kind.curves is not Machine.curves for kind in built_in)
    for source in (ScrollGasForces, OldhamKeyForces):
        assert "curves" in vars(source)


def test_curves_agree_with_the_figures_of_a_run():
    """Powers and peaks that a revolution reports, from 256 or so samples of it."""
    speed = {"mayekawa_wbhe": 1000.0, "dagilis_slider_link": 2950.0, "zhao_minicrank": 1500.0}
    figures = {
        name: va.load_machine(machine_file(name)).revolution(rpm, 256).figures
        for name, rpm in speed.items()
    }
    losses = inner("dagilis_slider_link")
    assert _power(losses, "slider in the link") == pytest.approx(
        figures["dagilis_slider_link"]["link_friction_w"], rel=1e-3
    )
    assert _power(losses, "piston") == pytest.approx(
        figures["dagilis_slider_link"]["piston_friction_w"], rel=1e-3
    )
    torque = inner("zhao_minicrank")["input_torque"].sel(torque_of="all")
    assert float(abs(torque).max()) == pytest.approx(
        figures["zhao_minicrank"]["largest_input_torque_nm"], rel=1e-2
    )
    efficiency = inner("mayekawa_wbhe")["mechanical_efficiency"]
    assert 100.0 * efficiency.sel(design_speed=1000.0, bore=0.13, method="nearest").item() == (
        pytest.approx(figures["mayekawa_wbhe"]["mechanical_efficiency_percent"], rel=1e-5)
    )


def _power(curves: xr.Dataset, where: str) -> float:
    """Mean over time of a power over the crank angle."""
    slowness = 1.0 / curves["crank_speed"]
    lost = curves["friction_power"].sel(lost_in=where) * slowness
    return float(lost.mean() / slowness.mean())


def test_option_that_changes_the_machine_changes_its_curves():
    study = va.load_study(PIPELINES / "zhao_minicrank.toml")
    assert "pin_force" not in va.curves(study, 1500.0)
    rigid = va.curves(study, 1500.0, "one-rigid-minicrank")
    assert float(rigid["pin_force"].max()) > 1e4
    assert rigid.attrs["option"] == "one-rigid-minicrank"


@pytest.mark.long
def test_bores_without_a_best_one_leave_it_out():
    machine = va.load_machine(machine_file("mayekawa_wbhe"))
    pairs = machine.sliding_pairs.model_copy(update={"bearing_friction": 0.0})
    curves = va.curves(machine.model_copy(update={"sliding_pairs": pairs}))
    assert "best_design" not in curves
    assert "mechanical_efficiency" in curves


def test_command_writes_dataset_tables_and_pictures(tmp_path: Path):
    outcome = command_here("curves", ZHAO, "--speed", 1500, "--out", tmp_path)
    assert outcome.returncode == 0, outcome.stderr
    assert "ideal_input_torque: " in outcome.stdout
    written = va.open_results(tmp_path / "curves.nc")
    xr.testing.assert_identical(written, inner("zhao_minicrank"))
    for name, curve in written.items():
        assert (tmp_path / f"{name}.svg").read_bytes()[:4] == b"<svg"
        table = _table(tmp_path / f"{name}.csv")
        np.testing.assert_allclose(table[:, 0], shown(curve[curve.dims[-1]]), rtol=1e-8)
        values = shown(curve).reshape(-1, curve.shape[-1]).T
        np.testing.assert_allclose(table[:, 1:], values, rtol=1e-8, atol=1e-12)
    chart_of(written, "pin_force")  # is drawn from the file alone


def _table(path: Path) -> np.ndarray:
    rows = list(csv.reader(path.read_text(encoding="utf-8").splitlines()))
    assert len(set(rows[0])) == len(rows[0])
    return np.array(rows[1:], dtype=float)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ((ZHAO, "--speed", 30), ("speed_rpm = 30 rpm: allowed 60 to 60000 rpm",)),
        ((ZHAO, "--speed", "nan"), ("speed_rpm = nan rpm: allowed",)),
        ((ZHAO, "--option", "hood"), ("option = hood: unknown; allowed none",)),
        (
            (PIPELINES / "zhao_minicrank.toml", "--option", "hod"),
            ("option = hod: unknown; allowed none, ", "one-rigid-minicrank"),
        ),
        (("missing.toml",), ("missing.toml: no such file",)),
    ],
)
def test_refusals_are_one_line(words, expected, tmp_path):
    assert_refused(command_here("curves", *words, "--out", tmp_path), *expected)


def test_machine_without_curves_is_refused():
    class Plain(Machine):
        kind = "plain"

    with pytest.raises(ParameterError, match="its kind plain has no curves"):
        va.curves(Plain(**fields_of_a_machine()))


def test_unknown_curve_names_those_that_there_are():
    with pytest.raises(ParameterError, match="curve film: unknown; allowed external_force, "):
        chart_of(inner("zhao_minicrank"), "film")


def test_page_names_every_curve():
    page = (ROOT / "docs" / "curves.md").read_text(encoding="utf-8")
    missing = {
        str(variable)
        for name in FILES
        for variable in inner(name).data_vars
        if f"`{variable}`" not in page
    }
    assert not missing


def test_curve_of_a_third_party_that_cannot_be_is_one_line():
    class Broken(Machine):
        kind = "broken"

        def curves(self, speed_rpm):
            angle = va.CurveAxis("crank_angle", np.arange(3.0), "deg")
            yield va.Curve("load", "Load", np.full(3, np.inf), (angle,), "n_m", "assumed")

    with pytest.raises(ParameterError, match="curve load: values must be finite"):
        va.curves(Broken(**fields_of_a_machine()))


def test_curve_of_a_third_party_is_drawn():
    class Flywheel(Machine):
        kind = "flywheel"

        def curves(self, speed_rpm):
            speeds = va.CurveAxis("shaft_speed", np.array([0.0, 3000.0, 6000.0]), "rpm")
            modes = va.CurveAxis("whirl_mode", ["backward", "forward"])
            values = np.array([[60.0, 50.0, 40.0], [60.0, 70.0, 80.0]])
            axes = (modes, speeds)
            yield va.Curve("whirl", "Whirl", values, axes, "hz", "assumed", orders=(1.0, 2.0))

    curves = va.curves(Flywheel(**fields_of_a_machine()))
    (axes,) = va.plot.curves(curves, "whirl").axes
    assert len(axes.lines) == 4  # two modes, two orders
    assert axes.get_xlabel() == "Shaft speed, rpm"
    assert axes.get_ylabel() == "Whirl,\u00a0Hz"


def fields_of_a_machine() -> dict[str, object]:
    bare = va.load_machine(ZHAO)
    return {name: getattr(bare, name) for name in Machine.model_fields}
