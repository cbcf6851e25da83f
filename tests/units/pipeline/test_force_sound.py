"""Measured sound pressure per force in a study: what comes out is force times what was measured."""

import numpy as np
import pytest
from support import ROOT

import vibroacoustics as va
from vibroacoustics.study.study import Study
from vibroacoustics.transfer import on_mounts

TINY = ROOT / "tests" / "studies" / "tiny.toml"
FREQUENCY = np.arange(10.0, 1001.0, 10.0)
FEET = ("front_left", "front_right", "rear_left", "rear_right")
HITS = [(0.1, 0.05, 0.2), (-0.12, 0.03, -0.1), (0.02, -0.11, 0.05)]
SOFTER = {
    "kind": "redesign",
    "added_mass_kg": 0.0,
    "change": {"mounts": {"vertical_stiffness_n_per_mm": {"value": 20.0, "source": "softer"}}},
}


def made_up(number):
    """Pa/N, smooth and linear between the lines that were measured."""
    rng = np.random.default_rng(number)
    ends = rng.normal(size=4)
    share = (FREQUENCY - 10.0) / 990.0
    return 0.01 * (ends[0] + 1j * ends[1] + share * (ends[2] + 1j * ends[3]))


def at(number, frequency):
    return np.interp(frequency, FREQUENCY, made_up(number))


def function(number, node, sign="+", unit="Pa"):
    turned = -1.0 if sign == "-" else 1.0
    at, force = va.Node(101), va.Node(node[0], sign + node[1])
    values = turned * made_up(number)
    return va.MeasuredFunction("frequency response", FREQUENCY, values, at, force, unit, "N")


def feet_table(folder):
    """Up and down and along x under each foot; one of them turned."""
    points, functions = {}, []
    for number, foot in enumerate(FEET):
        for axis in "zx":
            node = (11 + number, axis)
            functions.append(function(len(functions), node, "-" if len(functions) == 3 else "+"))
            points[f"{foot}_{axis}"] = {"node": node[0], "direction": f"+{axis}", "foot": foot}
    return _table(folder, points, functions)


def machine_table(folder):
    points, functions = {}, []
    for number, (x, y, z) in enumerate(HITS):
        for axis in "xyz":
            functions.append(function(len(functions), (31 + number, axis)))
            where = {"x_mm": 1e3 * x, "y_mm": 1e3 * y, "z_mm": 1e3 * z}
            points[f"h{number}{axis}"] = {"node": 31 + number, "direction": f"+{axis}", **where}
    return _table(folder, points, functions)


def _table(folder, points, functions):
    file = va.export_functions(functions, folder / "hammer.uff")
    microphones = {"front_1m": {"node": 101}}
    return {"frequency_responses": [str(file)], "points": points, "microphones": microphones}


def study(table, **more) -> Study:
    return va.load_study(TINY).replace({"measured.sound": table, **more})


def lines(results):
    """Pressure of orders from one, (option, order)."""
    pressure = results["pressure_line"].sel(speed=2900.0, receiver="front_1m").sum("sound_source")
    return pressure.transpose("option", "line").values[:, 1:]


def test_sound_of_feet_is_force_times_pressure_per_force_in_every_option(tmp_path):
    results = va.run(study(feet_table(tmp_path), **{"options.softer": SOFTER}))
    frequency = results["order_frequency"].sel(speed=2900.0).values[1:]
    force = results["foot_force_order"].sel(speed=2900.0).sum("source")
    expected = 0.0
    for number, foot in enumerate(FEET):
        for offset, axis in enumerate("zx"):
            one = force.sel(foot=foot, axis=axis).transpose("option", "order").values[:, 1:]
            expected = expected + one * at(2 * number + offset, frequency)
    np.testing.assert_allclose(lines(results), expected, atol=1e-10 * abs(expected).max())
    assert abs(expected[2] / expected[0] - 1.0).max() > 0.1  # softer mounts do something
    vectors = results["transfer_vector"].sel(receiver="front_1m")
    assert vectors.shape == (6, FREQUENCY.size)


def test_sound_of_the_machine_is_that_of_its_force_and_moment(tmp_path):
    """Each hit is one force; nine of them make any force and moment."""
    results = va.run(study(machine_table(tmp_path)))
    frequency = results["order_frequency"].sel(speed=2900.0).values[1:]
    parts = [results[name].sel(speed=2900.0).sum("source").transpose("option", "axis", "order")
             for name in ("force_order", "moment_order")]  # fmt: skip
    wrench = np.concatenate([part.values for part in parts], axis=1)[..., 1:]
    unit = [np.r_[axis, np.cross(hit, axis)] for hit in HITS for axis in np.eye(3)]
    forces = np.einsum("pw,owf->opf", np.linalg.pinv(np.array(unit).T), wrench)
    per_force = np.array([at(number, frequency) for number in range(9)])
    expected = np.einsum("opf,pf->of", forces, per_force)
    np.testing.assert_allclose(lines(results), expected, atol=1e-10 * abs(expected).max())


def test_another_body_makes_the_same_of_a_force_on_the_machine(tmp_path):
    """Velocity changes with its mass, pressure per velocity changes back."""
    from vibroacoustics.measured.sound_functions import force_sound_of

    given = study(machine_table(tmp_path))
    sound = force_sound_of(given)
    machine = given.machine
    housing = machine.housing.model_copy(update={"mass_kg": 2.0 * machine.housing.mass_kg})
    frequency, load = np.array([0.0, 48.0, 500.0]), np.array([1.0, 2.0, 0.5j, 0.1, 0.2, 0.3])
    pressures = []
    for each in (machine, machine.model_copy(update={"housing": housing})):
        body = on_mounts(each)
        velocity = body.response(load, frequency).velocity
        pressures.append(np.einsum("rdf,fd->rf", sound.of(body)(frequency), velocity))
    np.testing.assert_allclose(pressures[0], pressures[1], rtol=1e-9, atol=1e-15)
    assert pressures[0][0, 0] == 0.0
    np.testing.assert_allclose(sound.to([0])(frequency), sound(frequency))


WRONG = [
    ({"points.h0x.node": 99}, "frequency response 101/99+x is in none of the files"),
    ({"microphones": {"left": {"node": 101}}}, "measured.sound.microphones.front_1m: is missing"),
    ({"points.h0x.foot": "front_left"}, "needs either foot or x_mm, y_mm and z_mm"),
    ({"points.h0x": {"node": 11, "direction": "+x", "foot": "front_left"}}, "must be one"),
    ({"points": {"h0x": {"node": 31, "direction": "+x", "x_mm": 0.0, "y_mm": 0.0, "z_mm": 0.0}}},
     "hits span 1 of the six motions"),
    ({"frequency_responses": ["none.uff"]}, "none.uff: no such file"),
]  # fmt: skip


@pytest.mark.parametrize(("values", "words"), WRONG)
def test_what_is_wrong_is_one_line(tmp_path, values, words):
    changed = machine_table(tmp_path)
    for name, value in values.items():
        *tables, key = name.split(".")
        table = changed
        for each in tables:
            table = table[each]
        table[key] = value
    with pytest.raises((va.ParameterError, va.StorageError)) as raised:
        va.run(study(changed))
    assert words in str(raised.value)
    lines = str(raised.value).splitlines()
    assert len(lines) == (2 if "microphones" in values else 1), lines  # one missing, one unknown


@pytest.mark.filterwarnings("ignore:.*usual is")
@pytest.mark.parametrize(
    ("values", "words"),
    [({"operation.stopping": True}, "remove operation.stopping"),
     ({"options.softer": SOFTER}, "options.softer: stands otherwise than the machine that was"),
     ({"operation.speed_rpm": [540.0]}, "begins at 10 Hz, above the first order, 9 Hz")],
)  # fmt: skip
def test_what_it_cannot_tell_is_refused(tmp_path, values, words):
    with pytest.raises(va.ParameterError, match=words):
        va.run(study(machine_table(tmp_path), **values))


def test_functions_in_another_unit_are_refused(tmp_path):
    table = machine_table(tmp_path)
    functions = [function(n, (31 + n // 3, "xyz"[n % 3]), unit="m/s²") for n in range(9)]
    va.export_functions(functions, tmp_path / "hammer.uff")
    with pytest.raises(va.ParameterError, match="must be Pa/N"):
        va.run(study(table))
