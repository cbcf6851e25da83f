"""A shell by points: what is refused in one line, its size, and studies with it."""

import math
import tomllib

import numpy as np
import pytest
from support import ROOT

import vibroacoustics as va
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.base.revolution import capped_cylinder, polygon, shell_profile, sphere
from vibroacoustics.machine.shell import Shell
from vibroacoustics.machine.usual import Scale
from vibroacoustics.report.drawing.machine import outline
from vibroacoustics.results.run_attributes import Shell as StoredShell

MACHINE = ROOT / "data" / "machines" / "reciprocating_table.toml"
PLACE = {"centre_of_mass_height_m": 0.1, "floor_clearance_m": 0.02}
CONE = ((0.0, 0.0), (0.09, 0.0), (0.0, 0.3))
BOTTLE = ((0.0, 0.0), (0.1, 0.0), (0.1, 0.2), (0.05, 0.28), (0.05, 0.35), (0.0, 0.35))


def loaded(tmp_path, shell, machine=MACHINE):
    """The machine of a file with a shell, whose lines are TOML."""
    lines, inside = [], False
    for line in machine.read_text(encoding="utf-8").splitlines():
        inside = line == "[shell]" if line.startswith("[") else inside
        if not inside:
            lines.append(line.replace('"../', f'"{machine.parent.parent}/'))
    text = "\n".join(lines) + f"\n[shell]\n{shell}\n"
    (tmp_path / "machine.toml").write_text(text, encoding="utf-8")
    return va.load_machine(tmp_path / "machine.toml")


def written(points, more="centre_of_mass_height_mm = 100, floor_clearance_mm = 20"):
    keys = [f"profile_mm = {points}", *more.split(", ")]
    return "\n".join(
        f'{key} = {{ value = {value}, source = "drawing" }}'
        for key, value in (line.split(" = ", 1) for line in keys)
    )


def test_size_of_a_cone_and_a_sphere():
    """Pappus: 2π times the moment of the half section about the axis, exactly."""
    cone = polygon(CONE)
    assert cone.volume_m3 == pytest.approx(math.pi * 0.09**2 * 0.3 / 3.0, rel=1e-13)
    assert cone.centroid_z_m == pytest.approx(0.3 / 4.0, rel=1e-13)
    ball = sphere(0.1, 0.25)
    assert ball.volume_m3 == pytest.approx(4.0 / 3.0 * math.pi * 1e-3, rel=1e-13)
    assert ball.centroid_z_m == pytest.approx(0.25, rel=1e-13)
    dome = capped_cylinder(0.1, 0.0, 0.4, 0.05)
    volume = math.pi * 0.1**2 * (0.3 + 2.0 / 3.0 * 0.1)
    assert dome.volume_m3 == pytest.approx(volume, rel=1e-13)
    half = polygon([(0.0, 0.0), (0.1, 0.0), (0.1, 0.2), (0.0, 0.2)])
    assert (half.radius_m, half.height_m, half.centroid_z_m) == pytest.approx((0.1, 0.2, 0.1))


def test_volume_by_the_section_at_random_points():
    """The share of the enclosing cylinder in the bottle, one random point in each cell of it.

    The share of a cell that the profile crosses has a deviation of at most a half, of all others
    none. A profile that never widens crosses at most 2 x 60 of the 60 x 60 cells.
    """
    rng, side = np.random.default_rng(1), 60
    rows, columns = (np.indices((side, side)) + rng.random((2, side, side))) / side
    points = zip(0.1 * np.sqrt(rows.ravel()), 0.35 * columns.ravel(), strict=True)
    bottle = polygon(BOTTLE)
    inside = np.mean([bottle.distance_m(*point) == 0.0 for point in points])
    share = bottle.volume_m3 / (math.pi * 0.1**2 * 0.35)
    assert inside == pytest.approx(share, abs=4.0 * 0.5 * math.sqrt(2 * side) / side**2)


def test_distance_follows_the_profile():
    shell = Shell(profile_m=BOTTLE, **PLACE)
    assert shell.distance_m(0.06, 0.0, 0.02 + 0.32) == pytest.approx(0.01)
    assert shell.distance_m(1.05, 0.0, 0.02 + 0.32) == pytest.approx(math.hypot(0.95, 0.12))
    assert shell.distance_m(0.0, 1.1, 0.02 + 0.1) == pytest.approx(1.0)
    assert shell.distance_m(0.0, 0.0, 0.02 + 0.85) == pytest.approx(0.5)
    assert shell.distance_m(0.02, 0.0, 0.02 + 0.32) == 0.0
    assert shell.profile.bottom_z_m == pytest.approx(-0.1)
    assert Scale(shell, 20.0, 0.0).volume_m3 == shell.profile.volume_m3


@pytest.mark.filterwarnings("ignore:.*usual is")
def test_file_in_millimetres(tmp_path):
    points = [[1e3 * radius, 1e3 * height] for radius, height in BOTTLE]
    shell = loaded(tmp_path, written(points)).shell
    np.testing.assert_allclose(shell.profile_m, BOTTLE)
    with pytest.raises(ParameterError, match="no cylinder"):
        _ = shell.cylinder


REFUSED = {
    "2 points; allowed from 3 to 200": [[0, 0], [0, 300]],
    r"point 2 = \[-5, 10\] mm: the radius must not be negative":
        [[0, 0], [-5, 10], [90, 0], [0, 300]],
    r"first point = \[5, 0\] mm: must be on the axis": [[5, 0], [90, 0], [0, 300]],
    r"last point = \[5, 300\] mm: must be on the axis": [[0, 0], [90, 0], [5, 300]],
    "must run from its bottom to its top": [[0, 300], [90, 0], [0, 0]],
    "lowest height = 10 mm: must be 0": [[0, 10], [90, 10], [0, 300]],
    "the lines after point 1 and after point 3 cross":
        [[0, 0], [90, 200], [90, 0], [20, 250], [0, 300]],
    "the lines after point 2 and after point 3 cross or touch":
        [[0, 0], [90, 0], [90, 200], [90, 100], [50, 250], [0, 300]],
    "points 2 and 3: 0 mm apart": [[0, 0], [90, 0], [90, 0], [0, 300]],
    r"point 3 = \[0, 100\] mm: the profile crosses itself on the axis":
        [[0, 0], [90, 0], [0, 100], [90, 200], [0, 300]],
    "largest radius = 5 mm: allowed from 10 to 1000 mm": [[0, 0], [5, 0], [0, 300]],
    "below 90 mm, the height of the shell": [[0, 0], [90, 0], [0, 90]],
    "must be a number": [[0, 0], ["a", 0], [0, 300]],
}  # fmt: skip


@pytest.mark.parametrize("reason", REFUSED)
def test_refused_in_one_line(tmp_path, reason):
    with pytest.raises(ParameterError, match=reason) as refused:
        loaded(tmp_path, written(REFUSED[reason]))
    assert len(refused.value.args) == 1
    assert "machine.toml: shell" in str(refused.value)


def test_both_or_neither_is_refused(tmp_path):
    place = "centre_of_mass_height_mm = 100, floor_clearance_mm = 20"
    with pytest.raises(ParameterError, match="takes the place of outer_diameter_mm") as both:
        loaded(tmp_path, written([[0, 0], [90, 0], [0, 300]], f"height_mm = 300, {place}"))
    with pytest.raises(ParameterError, match="outer_diameter_mm: missing; give") as neither:
        loaded(tmp_path, written("", f"height_mm = 300, {place}").partition("\n")[2])
    assert len(both.value.args) == len(neither.value.args) == 1


@pytest.mark.filterwarnings("ignore:.*usual is")
def test_hollow_bottom_on_the_floor_is_refused(tmp_path):
    hollow = [[0, 30], [80, 0], [90, 0], [0, 300]]
    loaded(tmp_path, written(hollow))
    with pytest.raises(ParameterError, match="would enclose air on the floor"):
        loaded(tmp_path, written(hollow, "centre_of_mass_height_mm = 100, floor_clearance_mm = 0"))


@pytest.mark.parametrize("table", ["structure", "discharge_dome", "suction_annulus"])
def test_elastic_wall_and_gas_are_refused(tmp_path, table):
    copeland = MACHINE.parent / "copeland_zp41k3e.toml"
    others = {"structure", "variation", "frame", "discharge_dome", "suction_annulus"} - {table}
    tables = [name for name in tomllib.loads(copeland.read_text()) if name not in others]
    assert table in tables
    text, kept = [], True
    for line in copeland.read_text(encoding="utf-8").splitlines():
        if line.startswith("["):
            kept = line.strip("[]").partition(".")[0] in tables
        text += [line] if kept else []
    (tmp_path / "data" / "machines").mkdir(parents=True)
    thinned = tmp_path / "data" / "machines" / "thinned.toml"
    thinned.write_text("\n".join(text), encoding="utf-8")
    with pytest.raises(ParameterError, match=f"shell.profile_mm, {table}: an elastic") as refused:
        loaded(tmp_path, written([[0, 0], [82, 0], [82, 300], [0, 417]]), thinned)
    assert len(refused.value.args) == 1


def test_picture_shows_the_profile():
    shell = Shell(profile_m=BOTTLE, **PLACE).model_dump(mode="json")
    stored = StoredShell.model_validate(shell).model_dump()
    lines = outline(stored, {})
    half = lines.side[: len(BOTTLE)]
    np.testing.assert_allclose(half, np.array(BOTTLE) - [0.0, 0.1])
    np.testing.assert_allclose(lines.side[::-1] * [-1.0, 1.0], lines.side)
    assert np.abs(lines.above).max() == pytest.approx(0.1)
    assert shell_profile(stored).height_m == pytest.approx(0.35)
    with pytest.raises(ValueError, match="or profile_m"):
        StoredShell.model_validate(shell | {"profile_m": None})
