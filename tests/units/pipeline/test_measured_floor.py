"""A floor by measured functions against the same floor by the tables of a machine."""

from dataclasses import replace

import numpy as np
import pytest
from support import ROOT, made_up_radiation

import vibroacoustics as va

TINY = ROOT / "tests" / "studies" / "tiny.toml"
FREQUENCY = np.arange(2.0, 801.0, 2.0)
FEET = ("front_left", "front_right", "rear_left", "rear_right")
FLOOR = {"mass_kg": 20.0, "stiffness_n_per_mm": 400.0, "loss_factor_ratio": 0.05}
SOURCE = "measured"


def receptance(number):
    """Of a mass on a spring, another under each foot, m/N."""
    omega = 2.0 * np.pi * FREQUENCY
    return 1.0 / ((4e5 + 1e5 * number) * (1 + 0.05j) - omega**2 * 20.0)


def functions(unit="m/s²", axis="z", numbers=range(4)):
    return [
        va.MeasuredFunction(
            "frequency response", FREQUENCY, receptance(number), va.Node(11 + number, f"+{axis}"),
            va.Node(11 + number, f"+{axis}"), "m", "N",
        ).with_response_in(unit)
        for number in numbers
    ]  # fmt: skip


def table(file, direction="-z"):
    points = {
        f"p{number}": {"node": 11 + number, "direction": direction, "foot": foot}
        for number, foot in enumerate(FEET)
    }
    return {"frequency_responses": [str(file)], "points": points}


def run(study):
    return va.run(study, radiation=made_up_radiation)


@pytest.mark.parametrize(("unit", "name"), [("m/s²", "f.uff"), ("m/s", "f.csv")])
def test_measured_functions_are_the_machines_table_of_mobilities(tmp_path, unit, name):
    rows = "".join(
        f"{foot},{f!r},{abs(y):.17g},{np.degrees(np.angle(y)):.17g}\n"
        for number, foot in enumerate(FEET)
        for f, y in zip(FREQUENCY.tolist(), receptance(number), strict=True)
    )
    machine = tmp_path / "machine.toml"
    given = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
    file = '[floor_mobility]\nfile = { value = "floor.csv", source = "measured" }\n'
    machine.write_text(f"{given}\n{file}")
    (tmp_path / "floor.csv").write_text(
        f"foot,frequency_hz,vertical_receptance_m_per_n,vertical_phase_deg\n{rows}"
    )
    rigid = va.load_study(TINY)
    by_table = run(rigid.replace({"machine.file": str(machine)}))
    written = va.export_functions(functions(unit), tmp_path / name)
    measured = run(rigid.replace({"measured.floor": table(written)}))
    for variable in ("velocity_order", "foot_force_order", "level_total"):
        expected = by_table[variable].values
        size = abs(expected).max()
        np.testing.assert_allclose(measured[variable].values, expected, atol=1e-9 * size)
    still = run(rigid)["foot_force_order"].values
    assert abs(measured["foot_force_order"].values - still).max() > 0.01 * abs(still).max()
    assert "floor_mobility" in measured.attrs["parameters"]


def test_sideways_and_repeats(tmp_path):
    """Half and one and a half times the function average to it; sideways is given for one foot."""
    more = [replace(one, values=1.5 * one.values) for one in functions()]
    less = [replace(one, values=0.5 * one.values) for one in functions()]
    sideways = functions(axis="x", numbers=[0])
    file = va.export_functions([*more, *less, *sideways], tmp_path / "f.uff")
    alone = va.export_functions(functions(), tmp_path / "alone.uff")
    study = va.load_study(TINY)
    point = {"node": 11, "direction": "+x", "foot": "front_left"}
    both = table(file) | {"points": table(file)["points"] | {"side": point}}
    first = run(study.replace({"measured.floor": table(alone)}))
    second = run(study.replace({"measured.floor": both}))
    axes = (first - second)["foot_force_order"]
    size = abs(first["foot_force_order"]).max()
    assert abs(axes.sel(axis="x")).max() > 1e-4 * size
    only = run(study.replace({"measured.floor": table(file)}))
    np.testing.assert_allclose(
        only["foot_force_order"].values, first["foot_force_order"].values, atol=1e-9 * float(size)
    )


WRONG = [
    ({"points.p0.node": 99}, "frequency response 99+z/99+z of front_left is in none of the files"),
    ({"points.p0.foot": "middle"}, "has no rows for front_left"),
    ({"points.p0.foot": "front_right"}, "2 points up and down under front_right"),
    ({"points.p0.direction": "+x"}, "front_left has a point sideways and none up and down"),
    ({"frequency_responses": ["none.uff"]}, "none.uff: no such file"),
]


@pytest.mark.parametrize(("values", "words"), WRONG)
def test_what_is_wrong_is_one_line(tmp_path, values, words):
    changed = table(va.export_functions(functions(), tmp_path / "f.uff"))
    for name, value in values.items():
        *tables, key = name.split(".")
        at = changed
        for each in tables:
            at = at[each]
        at[key] = value
    with pytest.raises((va.ParameterError, va.StorageError)) as raised:
        run(va.load_study(TINY).replace({"measured.floor": changed}))
    assert words in str(raised.value)
    assert "\n" not in str(raised.value)


def test_two_floors_are_refused(tmp_path):
    machine = tmp_path / "machine.toml"
    given = (ROOT / "data" / "machines" / "copeland_zp41k3e.toml").read_text()
    values = "".join(
        f'{key} = {{ value = {value}, source = "{SOURCE}" }}\n' for key, value in FLOOR.items()
    )
    machine.write_text(f"{given}\n[floor]\n{values}")
    file = va.export_functions(functions(), tmp_path / "f.uff")
    study = va.load_study(TINY).replace(
        {"machine.file": str(machine), "measured.floor": table(file)}
    )
    with pytest.raises(va.ParameterError, match=r"machine\.floor: is a floor too"):
        run(study)
