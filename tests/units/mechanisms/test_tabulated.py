"""A machine by a table of its forces: equal to the machine they come from; bad tables in a line."""

import tomllib
from pathlib import Path

import numpy as np
import pytest
from support import ROOT, made_up_radiation

import vibroacoustics as va
from vibroacoustics import pipeline
from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanisms.oldham_scroll.machine import OldhamScroll
from vibroacoustics.mechanisms.tabulated.csv_layout import forces_csv
from vibroacoustics.mechanisms.tabulated.other_files import read_spectra
from vibroacoustics.mechanisms.tabulated.shaft_axes import ShaftAxes, axes_lines
from vibroacoustics.mechanisms.tabulated.spectra import Spectra, orders_of, over_revolution
from vibroacoustics.orders.spectrum import order_spectrum_at_speed
from vibroacoustics.report.sections.assumptions import not_modelled
from vibroacoustics.results import storage
from vibroacoustics.study.loading import load_machine, load_study

COPELAND = ROOT / "data" / "machines" / "copeland_zp41k3e.toml"
SMALL = ROOT / "tests" / "studies" / "small.toml"
ANGLES = "speed_rpm,crank_angle_deg,source,fx_n,fy_n,fz_n,mx_nm,my_nm,mz_nm\n"
ORDERS = (
    "speed_rpm,order,source,fx_n,fx_phase_deg,fy_n,fy_phase_deg,fz_n,fz_phase_deg,"
    "mx_nm,mx_phase_deg,my_nm,my_phase_deg,mz_nm,mz_phase_deg\n"
)


AXES = '\n[shaft_axes]\nstroke = "x"\nshaft = "z"\n'


def table_machine(folder: Path, name: str, more: str = AXES, forces: str = "") -> Path:
    """A machine file in place of the Copeland's mechanism, beside a table of forces."""
    text = COPELAND.read_text()
    keep = ("housing", "counterweights", "mounts", "shell", "overall_noise", "remainder")
    blocks = text.split("\n[")[1:]
    tables = ["\n[" + block for block in blocks if block.split("]")[0] in keep]
    growth = OldhamScroll.speed_growth.mean_db  # a table has no kind that knows it
    line = f'speed_growth_db = {{ value = {growth}, source = "a test" }}'
    tables = [table.replace("[remainder]\n", f"[remainder]\n{line}\n") for table in tables]
    file = folder / "machine.toml"
    file.write_text(
        'name = "Copeland ZP41K3E-PFJ"\nkind = "table"\n'
        f'[forces]\nfile = {{ value = "{name}", source = "a test" }}\n{forces}{more}'
        + "".join(tables)
    )
    return file


def ring_tables(machine) -> str:
    """What options work on, as the scroll has it."""
    ring, stroke = machine.oldham, machine.kinematics.orbit_radius_m
    values = "".join(
        f'{key} = {{ value = {value!r}, source = "a test" }}\n'
        for key, value in (
            ("mass_kg", ring.mass_kg), ("amplitude_m", stroke), ("height_m", ring.height_m)
        )
    )  # fmt: skip
    return f"\n[oldham]\n{values}\n[sliding_mass]\n{values}"


def by_angle(results) -> str:
    """The forces of a run over crank angle, as its machine makes them."""
    parts = [
        results[name].sel(option="none").transpose("speed", "source", "crank_angle", "axis")
        for name in ("force", "moment")
    ]
    values = np.concatenate([part.values for part in parts], axis=-1)
    lines = [
        f"{speed},{float(np.degrees(angle))!r},{source},{','.join(map(repr, row.tolist()))}"
        for speed, of_speed in zip(results["speed"].values, values, strict=True)
        for source, of_source in zip(results["source"].values, of_speed, strict=True)
        if of_source.any()
        for angle, row in zip(results["crank_angle"].values, of_source, strict=True)
    ]
    return ANGLES + "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def scroll():
    study = load_study(SMALL)
    return study, pipeline.run(study, radiation=made_up_radiation)


ROUNDING_DB = 200.0
"""Level under the loudest line from which a line is rounding noise: 1e-10 of it."""


ROUNDING_SHARE = 1e-6
"""Share of the sound below which a path's phase is rounding noise: 1e-9 of a pressure at 1e-3."""


@pytest.mark.parametrize("layout", ["by angle", "by order", "results"])
def test_table_of_the_scroll_gives_what_the_scroll_gives(scroll, tmp_path, layout):
    """Every number of every option, but for the time series of a table that stops at an order."""
    study, expected = scroll
    name = {"by angle": "a.csv", "by order": "o.csv", "results": "r.nc"}[layout]
    if layout == "results":
        storage.write_results(expected, tmp_path / name)
    elif layout == "by order":
        (tmp_path / name).write_bytes(forces_csv(expected))
    else:
        (tmp_path / name).write_text(by_angle(expected))
    file = table_machine(tmp_path, name, AXES + ring_tables(study.machine))
    table = study.replace({"machine.file": str(file), "machine.override": None})
    found = pipeline.run(table, radiation=made_up_radiation)
    series = set() if layout == "by angle" else {"force", "moment"}
    numeric = [n for n in expected.data_vars if expected[n].dtype.kind in "fc" and n not in series]
    assert set(expected.data_vars) == set(found.data_vars)
    for variable in numeric:
        dims = expected[variable].dims
        other = found[variable]
        if "source" in dims:
            other = other.sel(source=expected["source"].values)
        pair = other.transpose(*dims).values, expected[variable].values
        if variable == "order_change":  # of lines that are zero it is a ratio of rounding noise
            level = expected["order_level"].sel(weighting="Z")
            sounds = (level > level.max() - ROUNDING_DB).transpose(*dims)
            sounds = (sounds & sounds.sel(option="none")).values
            assert sounds.any(axis=dims.index("order")).all()
            pair = tuple(np.where(sounds, change, 0.0) for change in pair)
        if variable.endswith("_cosine"):  # of a path without sound it is of rounding noise
            share = expected[variable.replace("cosine", "share")]
            sounds = (np.abs(share) > ROUNDING_SHARE).transpose(*dims).values
            assert sounds.any()
            pair = tuple(np.where(sounds, cosine, 0.0) for cosine in pair)
        if "dB" in expected[variable].attrs.get("units", ""):  # a level of what is zero is rounding
            pair = tuple(10.0 ** (level / 20.0) for level in pair)
        size = np.nanmax(np.abs(pair[1]), initial=1e-12)
        np.testing.assert_allclose(*pair, rtol=1e-9, atol=1e-9 * size, err_msg=variable)


def test_between_speeds_a_force_of_inertia_or_a_constant_one_is_exact():
    speeds = (1000.0, 1500.0, 4000.0)
    shape = (1, 6, 3)
    generator = np.random.default_rng(2)
    inertia, gas = (generator.normal(size=shape) + 1j * generator.normal(size=shape) for _ in "ab")
    spectra = Spectra(speeds, ("all",), np.array([gas + inertia * n**2 for n in speeds]))
    for speed in (*speeds, 1200.0, 3999.0):
        np.testing.assert_allclose(spectra.between(speed), gas + inertia * speed**2, rtol=1e-12)
    np.testing.assert_array_equal(spectra.between(1500.0), spectra.orders[1])


@pytest.mark.parametrize("samples", [15, 16])
def test_orders_and_revolution_are_inverse(samples):
    orders = np.zeros((2, 8), dtype=complex)
    orders[0, :3] = 2.0, 1.0 - 2.0j, 0.5j
    angle = 2.0 * np.pi * np.arange(samples) / samples
    signal = 2.0 + (np.exp(1j * angle) * (1.0 - 2.0j) + np.exp(2j * angle) * 0.5j).real
    np.testing.assert_allclose(over_revolution(orders, samples)[0], signal, atol=1e-14)
    np.testing.assert_allclose(orders_of(signal), orders[0, :8], atol=1e-14)


def small_table(speed: float = 3000.0, steps: int = 8, source: str = "crank") -> str:
    return "".join(
        f"{speed},{360.0 * n / steps},{source},{np.cos(2 * np.pi * n / steps):.6f},0,0,0,0,1\n"
        for n in range(steps)
    )


def forces_of(folder: Path, text: str, forces: str = ""):
    (folder / "f.csv").write_text(text)
    return load_machine(table_machine(folder, "f.csv", forces=forces)).forces


def test_one_speed_reaches_others_only_as_inertia(tmp_path):
    fixed = forces_of(tmp_path, ANGLES + small_table())
    np.testing.assert_allclose(fixed.orders_at(3000.0)[0, 0, 1], 1.0, rtol=1e-6)
    with pytest.raises(ParameterError, match=r"has 3000 rpm alone; scaling = .inertia. lets"):
        fixed.orders_at(3600.0)
    grown = forces_of(tmp_path, ANGLES + small_table(), 'scaling = "inertia"\n')
    np.testing.assert_allclose(grown.orders_at(3600.0), 1.44 * fixed.orders_at(3000.0), rtol=1e-12)
    two = forces_of(tmp_path, ANGLES + small_table() + small_table(3500.0))
    with pytest.raises(ParameterError, match=r"f.csv: speed_rpm = 3600 rpm: .* has 3000 to 3500"):
        two.orders_at(3600.0)
    again = type(two).model_validate_json(two.model_dump_json())
    assert again == two
    assert two.file == "f.csv"


def test_columns_in_other_units_and_a_closing_row(tmp_path):
    head = ANGLES.replace("fx_n", "fx_kn").replace("source,", "")
    text = small_table().replace(",crank", "") + "3000,360,1.000000,0,0,0,0,1\n"
    forces = forces_of(tmp_path, f"# a remark\n{head}{text}")
    np.testing.assert_allclose(forces.orders_at(3000.0)[0, 0, 1], 1000.0, rtol=1e-6)
    assert forces.sources == ("table",)


def test_universal_file_over_time(tmp_path):
    """Two revolutions of force and moment; other orders than whole ones of the shaft go."""
    pyuff = pytest.importorskip("pyuff")
    rate, samples = 6400.0, 256  # two revolutions at 3000 rpm
    time = np.arange(samples) / rate
    wave = 3.0 * np.cos(2.0 * np.pi * 50.0 * time + 0.4)
    for name, unit, samples in (("crank fx", "N", wave), ("crank my", "N m", 0.1 * wave)):
        pyuff.UFF(str(tmp_path / "f.uff")).write_sets(
            pyuff.prepare_58(
                binary=1, func_type=1, rsp_node=1, rsp_dir=1, ref_node=1, ref_dir=1,
                data=samples, x=time, id1=name, abscissa_spacing=1,
                ordinate_spec_data_type=0, orddenom_spec_data_type=0, z_axis_spec_data_type=0,
                abscissa_inc=1.0 / rate, abscissa_min=0.0, ordinate_axis_units_lab=unit,
            ),
            "add",
        )  # fmt: skip
    file = table_machine(tmp_path, "f.uff", forces="recorded_speed_rpm = 3000.0\n")
    text = file.read_text().replace("3000.0\n", '{ value = 3000.0, source = "tacho" }\n', 1)
    file.write_text(text)
    orders = load_machine(file).forces.orders_at(3000.0)
    np.testing.assert_allclose(orders[0, 0, 1], 3.0 * np.exp(0.4j), rtol=1e-6)
    np.testing.assert_allclose(orders[0, 4, 1], 0.3 * np.exp(0.4j), rtol=1e-6)
    np.testing.assert_allclose(np.delete(orders[0, 0], 1), 0.0, atol=1e-6)
    file.write_text(text.replace("3000.0", "3100.0"))
    with pytest.raises(ParameterError, match=r"2.06667 revolutions at 3100 rpm: must be whole"):
        load_machine(file)


def test_spectra_of_a_universal_file_are_orders_of_their_nodes(tmp_path):
    """Forces along, moments about the axes of a node; against the stated speed."""
    hertz = np.array([50.0, 100.0, 150.0])
    force, moment = np.array([1.0, 2.0j, 3.0]), np.array([0.5, 0.0, 0.1j])
    functions = [
        va.MeasuredFunction("spectrum", hertz, force, va.Node(7, "-z"), None, "N"),
        va.MeasuredFunction("spectrum", hertz, moment, va.Node(7, "+rx"), None, "N m"),
        va.MeasuredFunction("spectrum", hertz, force, va.Node(8, "+x"), None, "N"),
    ]
    va.export_functions(functions, tmp_path / "s.uff")
    file = table_machine(tmp_path, "s.uff", forces="recorded_speed_rpm = 3000.0\n")
    text = file.read_text().replace("3000.0\n", '{ value = 3000.0, source = "tacho" }\n', 1)
    file.write_text(text)
    table = load_machine(file).forces
    assert table.sources == ("7", "8")
    orders = table.orders_at(3000.0)
    np.testing.assert_allclose(orders[0, 2], [0.0, *-force])
    np.testing.assert_allclose(orders[0, 3], [0.0, *moment])
    np.testing.assert_allclose(orders[1, 0], [0.0, *force])
    assert np.count_nonzero(orders) == 8
    file.write_text(text.replace("3000.0", "3010.0"))
    with pytest.raises(ParameterError, match=r"50 Hz is order 0.9967|150 Hz is order 2.99"):
        load_machine(file)


def test_one_line_of_a_universal_file_off_the_orders_is_refused(tmp_path):
    """120 Hz at 3000 rpm, between two whole orders."""
    hertz, force = np.array([50.0, 120.0, 150.0]), np.array([1.0, 2.0j, 3.0])
    function = va.MeasuredFunction("spectrum", hertz, force, va.Node(7, "+z"), None, "N")
    va.export_functions([function], tmp_path / "s.uff")
    with pytest.raises(ParameterError, match=r"120 Hz is order 2\.4 at 3000 rpm: must be a whole"):
        read_spectra(tmp_path / "s.uff", 3000.0)


ROW = "3000,0,crank,1,0,0,0,0,0\n"
LINE = "3000,1,crank" + ",1,0" * 6 + "\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (ANGLES.replace("fy_n,", "") + ROW, "fy_n is missing"),
        (ANGLES.replace("fy_n", "fy_bar") + ROW, "fy_bar: unit bar: must be kN or N, as in fy_n"),
        (ANGLES.replace("crank_angle_deg,", ""), "crank_angle_rad is missing"),
        (ANGLES, "has no rows"),
        (ANGLES + ROW.replace("1,0", "nan,0"), "line 2: fx_n = nan: must be a finite number"),
        (ANGLES + ROW.replace("1,0", "1e999,0"), "line 2: fx_n = 1e999: must be a finite number"),
        (ANGLES + ROW.replace("3000", "0"), "line 2: speed_rpm = 0 rpm: must be above 0"),
        (ANGLES + ROW.replace("crank", ""), "line 2: source: is missing"),
        (ANGLES + ROW + ROW, "line 3: crank_angle_deg = 0: is given twice"),
        (ANGLES + small_table().replace("90.0,", "91.0,", 1), "crank_angle_deg = 91: 8 angles mu"),
        (ANGLES + small_table() + "3000,360,crank,2,0,0,0,0,1\n",
         "fx_n = 2 at 360°, 1 at 0°: is not periodic"),
        (ANGLES + small_table() + small_table(3500.0, source="ring"), "ring has no rows at 3000"),
        (ANGLES + "".join(f"3000,{n}0,crank,1,0,0,0,0,0\n" for n in (0, 12, 24)),
         "all forces and moments are constant"),
        (ORDERS + LINE + LINE, "line 3: order = 1: is given twice"),
        (ORDERS + LINE.replace("0,1,", "0,1.5,", 1), "order = 1.5: must be a whole number from 0"),
        (ORDERS.replace(",mz_phase_deg", "") + LINE[:-3] + "\n", "crank_angle_rad or "),
    ],
)  # fmt: skip
def test_bad_tables_are_refused_in_a_line(tmp_path, text, words):
    with pytest.raises(ParameterError) as refusal:
        forces_of(tmp_path, text)
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("name", "forces", "words"),
    [
        ("none.csv", "", "none.csv: no such file"),
        ("none.nc", "", "none.nc: no such file"),
        ("f.csv", 'scaling = "gas"\n', "scaling"),
        ("two.csv", 'scaling = "inertia"\n', "for a table of one speed; two.csv has 2"),
        ("f.uff", "", "f.uff: recorded_speed_rpm is missing"),
        ("f.nc", "", "f.nc: holds no force_order and moment_order of a run"),
        ("h.nc", "", "h.nc: is no result file: a heap in it is damaged"),
    ],
)
def test_bad_names_are_refused_in_a_line(tmp_path, name, forces, words):
    (tmp_path / "f.csv").write_text(ANGLES + small_table())
    (tmp_path / "two.csv").write_text(ANGLES + small_table() + small_table(3500.0))
    (tmp_path / "f.nc").write_bytes(b"nothing")
    heap = b"GCOL\1\0\0\0" + (4096).to_bytes(8, "little") + bytes(4096)
    (tmp_path / "h.nc").write_bytes(heap)
    with pytest.raises(ParameterError) as refusal:
        load_machine(table_machine(tmp_path, name, forces=forces))
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(("speed_rpm", "bound"), [(900.0, 1e-9), (950.0, 1e-3)])
def test_example_is_the_machine_that_it_was_made_from(speed_rpm, bound):
    """At a speed of its table, and between two of them, where the shaft swings otherwise."""
    table = load_machine(ROOT / "data" / "machines" / "reciprocating_table.toml")
    machine = load_machine(ROOT / "data" / "machines" / "mayekawa_wbhe.toml")
    assert table.forces.speed_rpm == (800.0, 900.0, 1000.0, 1100.0, 1200.0)
    slider, known = table.require(va.Slider), machine.require(va.Slider)
    assert slider.frame == known.frame
    moment, exact = (each.mass_kg * each.amplitude_m for each in (slider, known))
    assert 1.0 < moment / exact < 1.01  # the shaft swings, and the rod's eyes are two masses
    revolution = machine.revolution(speed_rpm, 720)
    for at, source in enumerate(table.forces.sources):
        wrench = revolution.wrenches[source]
        expected = order_spectrum_at_speed(
            np.concatenate([wrench.force_n, wrench.moment_n_m]),
            revolution.rotation.speed_rad_per_s, 20,
        )  # fmt: skip
        found = table.forces.orders_at(speed_rpm)[at]
        assert np.abs(found - expected).max() < bound * np.abs(expected).max()


def test_example_study_goes_to_its_results_with_another_file_as_redesign():
    study = load_study(ROOT / "pipelines" / "reciprocating_table.toml")
    few = {"options.lanchester": None, "options.counterweight-half": None}
    results = pipeline.run(study.replace(few), radiation=made_up_radiation)
    foot = results["foot_force_amplitude"].sel(order=1).max("foot").values
    options = results["option"].values.tolist()
    soft, given = (foot[:, options.index(name)] for name in ("softer-mounts", "none"))
    assert np.all(soft < 0.5 * given)
    weighed = foot[:, options.index("counterweight-full")]
    assert np.all(weighed < 0.8 * given)
    assert results["foot"].values.tolist() == [f"foot_{number}" for number in range(1, 6)]
    assert any("known from 5 to 500 Hz" in text for text in not_modelled(results))


def test_a_machine_without_shaft_axes_is_refused_with_the_lines_to_add(tmp_path):
    (tmp_path / "f.csv").write_text(ANGLES + small_table())
    with pytest.raises(ParameterError) as refusal:
        load_machine(table_machine(tmp_path, "f.csv", more=""))
    assert str(refusal.value) == (
        f"{tmp_path / 'machine.toml'}: shaft_axes: is missing; add the lines [shaft_axes], "
        'stroke = "x", shaft = "z" with the directions of this machine, each x, y, z, -x, -y or -z'
    )
    half = '\n[shaft_axes]\nshaft = "z"\n'
    with pytest.raises(ParameterError, match=r"shaft_axes\.stroke: is missing"):
        load_machine(table_machine(tmp_path, "f.csv", more=half))


LYING = ROOT / "pipelines" / "reciprocating_table.toml"
TWO = {
    "options.softer-mounts": None, "options.counterweight-half": None,
    "operation.speed_rpm": [800.0, 1200.0],
}  # fmt: skip


def read_again(folder: Path, forces: Path, axes: str) -> Path:
    """The example's machine with another table of forces and other axes."""
    example = ROOT / "data" / "machines" / "reciprocating_table.toml"
    text = example.read_text().replace("../tables/reciprocating_forces.csv", str(forces))
    text = text.replace('"../tables', f'"{example.parent.parent / "tables"}')
    before, behind = text.split("[shaft_axes]\n")
    file = folder / "again.toml"
    file.write_text(f"{before}{axes}\n{behind[behind.index('[sliding_mass]') :]}")
    return file


def levels(machine: str | None = None):
    study = load_study(LYING).replace(TWO)
    if machine is not None:
        study = study.replace({"machine.file": machine})
    results = pipeline.run(study, radiation=made_up_radiation)
    return results, results["level_modelled"].sel(weighting="A").values


def test_exported_forces_of_a_lying_shaft_bring_its_axes(tmp_path):
    """Levels with and without a counterweight are the same; 1 dB off for an upright shaft."""
    results, expected = levels()
    file = va.export_forces(results, tmp_path / "forces.csv")
    remarks = [line[2:] for line in file.read_text().splitlines() if line.startswith("# ")]
    axes = "\n".join(remarks[remarks.index("[shaft_axes]") :])
    assert axes.startswith('[shaft_axes]\nstroke = "z"\nshaft = "y"\nz_m = { value = -0.06, ')
    found = levels(str(read_again(tmp_path, file, axes)))[1]
    np.testing.assert_allclose(found, expected, atol=0.01)
    upright = '[shaft_axes]\nstroke = "x"\nshaft = "z"'
    assert np.abs(levels(str(read_again(tmp_path, file, upright)))[1] - expected).max() > 1.0


@pytest.mark.parametrize("stroke", ["x", "-x", "y", "-z"])
@pytest.mark.parametrize("shaft", ["z", "-z", "-y"])
def test_axes_are_written_as_they_are_read(stroke, shaft):
    if stroke[-1] == shaft[-1]:
        with pytest.raises(ValueError, match="must be across the shaft"):
            ShaftAxes(stroke=stroke, shaft=shaft)
        return
    axes = ShaftAxes(stroke=stroke, shaft=shaft, x_m=0.1)
    table = tomllib.loads("\n".join(axes_lines(axes.frame._asdict(), "a test")))["shaft_axes"]
    assert table == {
        "stroke": stroke, "shaft": shaft, "x_m": {"value": 0.1, "source": "a test"}
    }  # fmt: skip


def test_axes_along_no_axis_are_a_remark():
    frame = ShaftAxes(stroke="x", shaft="z").frame._replace(stroke=(0.8, 0.6, 0.0))
    (remark,) = axes_lines(frame._asdict(), "a test")
    assert remark.startswith("# stroke or shaft is not along an axis")
