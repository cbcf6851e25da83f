"""Bad input: each mistake gives a line with file, field, value, unit and allowed range."""

import re
import shutil
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings
from hypothesis import strategies as st
from mutated_studies import PATHS, make_tree, write_changed
from support import MACHINE_FILE, PIPELINES, ROOT

from vibroacoustics.base.errors import LONGEST_LINE, ParameterError
from vibroacoustics.study.loading import load_study
from vibroacoustics.study.toml_files import MAXIMUM_FILE_BYTES

THESIS = (PIPELINES / "copeland_thesis.toml").read_text(encoding="utf-8")
MACHINE = MACHINE_FILE.read_text(encoding="utf-8")
SAMPLES = "crank_angle_samples = 256"


@pytest.fixture
def tree(tmp_path) -> Path:
    """A copy of the study, its machine and its table, in the same relative places."""
    shutil.copytree(PIPELINES, tmp_path / "pipelines")
    shutil.copytree(ROOT / "data" / "machines", tmp_path / "data" / "machines")
    shutil.copytree(ROOT / "data" / "validation", tmp_path / "data" / "validation")
    return tmp_path


def refused(path: Path) -> str:
    """The message of the refusal, checked to be short lines that name their file."""
    with pytest.raises(ParameterError) as caught:
        load_study(path)
    message = str(caught.value)
    check_lines(message, path.parent.parent)
    return message


def check_lines(message: str, folder: Path) -> None:
    """Each line names a file of the folder; the last may tell how many more there are."""
    lines = message.splitlines()
    assert lines
    if lines[1:] and re.fullmatch(r"and \d+ more", lines[-1]):
        lines.pop()
    assert all(line.startswith(f"{folder}/") for line in lines), message
    assert all(line.strip() == line and len(line) <= LONGEST_LINE for line in lines), message


def refuse_study(tree: Path, old: str, new: str) -> str:
    """Load the thesis study with one change."""
    assert THESIS.count(old) == 1, f"{old!r} must be in the study once"
    path = tree / "pipelines" / "copeland_thesis.toml"
    path.write_text(THESIS.replace(old, new), encoding="utf-8")
    return refused(path)


def refuse_machine(tree: Path, old: str, new: str) -> str:
    """Load the thesis study with one change to its machine."""
    assert MACHINE.count(old) == 1, f"{old!r} must be in the machine file once"
    (tree / "data" / "machines" / MACHINE_FILE.name).write_text(
        MACHINE.replace(old, new), encoding="utf-8"
    )
    return refused(tree / "pipelines" / "copeland_thesis.toml")


def says(message: str, *words: str) -> None:
    missing = [word for word in words if word not in message]
    assert not missing, f"{missing} not in: {message}"


# --- files ---------------------------------------------------------------------------------------


def test_missing_file(tmp_path):
    says(refused(tmp_path / "nowhere.toml"), "nowhere.toml", "no such file")


def test_folder_in_place_of_a_file(tmp_path):
    says(refused(tmp_path), str(tmp_path), "cannot be read")


def test_invalid_toml(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text('title = "open\n')
    says(refused(path), "study.toml", "not valid TOML", "line 1")


def test_text_that_is_not_utf8(tmp_path):
    path = tmp_path / "study.toml"
    path.write_bytes('title = "é"'.encode("latin-1"))
    says(refused(path), "study.toml", "UTF-8")


def test_huge_file(tmp_path):
    path = tmp_path / "study.toml"
    path.write_bytes(b"#" * (MAXIMUM_FILE_BYTES + 1))
    says(refused(path), "study.toml", "larger than")


def test_empty_file(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text("")
    says(refused(path), "study.toml", "machine.file")


def test_missing_machine_file(tree):
    says(refuse_study(tree, "copeland_zp41k3e.toml", "absent.toml"), "absent.toml", "no such file")


@pytest.mark.parametrize("name", ["", "a\\u0000b", "x" * 300])
def test_machine_file_that_cannot_be_a_file(tree, name):
    refuse_study(tree, "../data/machines/copeland_zp41k3e.toml", name)


def test_missing_published_table(tree):
    says(refuse_study(tree, "thesis_table_3.csv", "absent.csv"), "absent.csv")


def test_published_table_must_be_a_name(tree):
    old = 'published_table = "../data/validation/thesis_table_3.csv"'
    says(refuse_study(tree, old, "published_table = 3"), "copeland_thesis.toml", "published_table")


@pytest.mark.parametrize(
    "content",
    [b"", b"criterion,A\n", b"criterion,A\nx,1\n", b"criterion,A\nx,one\nsum,1\n",
     b"criterion,A,B\nx,1\nsum,1,1\n", b"criterion,A\nx\x00,1\nsum,1\n",
     b"criterion,A\nx,nan\nsum,1\n"],
)  # fmt: skip
def test_broken_published_table(tree, content):
    (tree / "data" / "validation" / "thesis_table_3.csv").write_bytes(content)
    message = refused(tree / "pipelines" / "copeland_thesis.toml")
    says(message, "thesis")


def test_extended_study_is_missing(tree):
    path = tree / "pipelines" / "copeland_derived.toml"
    path.write_text('extends = "absent.toml"\n')
    says(refused(path), "absent.toml", "no such file")


def test_extends_must_be_a_name(tree):
    path = tree / "pipelines" / "copeland_derived.toml"
    path.write_text("extends = 3\n")
    says(refused(path), "copeland_derived.toml", "extends", "3")


def test_chain_of_extends(tree):
    path = tree / "pipelines" / "third.toml"
    path.write_text('extends = "copeland_derived.toml"\ntitle = "third"\n')
    derived = load_study(tree / "pipelines" / "copeland_derived.toml")
    third = load_study(path)
    assert third.title == "third"
    assert third.machine == derived.machine


def test_circle_of_extends(tree):
    first, second = (tree / "pipelines" / f"{name}.toml" for name in ("first", "second"))
    first.write_text('extends = "second.toml"\n')
    second.write_text('extends = "first.toml"\n')
    says(refused(first), "second.toml", "extends = first.toml", "circle")


def test_study_that_extends_itself(tree):
    path = tree / "pipelines" / "self.toml"
    path.write_text('extends = "self.toml"\n')
    says(refused(path), "self.toml", "extends")


# --- keys ----------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("[operation]", "[extra]\nx = 1\n[operation]", ["extra", "unknown key"]),
        ("[operation]", "[operation]\nwarp = 9", ["operation.warp", "unknown key"]),
        ("[options.damping]", "[options.damping]\nwarp = 9", ["options.damping.warp", "unknown"]),
        # An option may have the name of its kind.
        (
            "[options.spring-mass]",
            "[options.spring-mass]\nwarp = 9",
            ["options.spring-mass.warp", "unknown key"],
        ),
        ("[options.none]", "[options.none]\nwarp = 9", ["options.none.warp", "unknown key"]),
        (
            "[machine.override.kinematics]",
            "[machine.override.kinematics]\nwarp = 9",
            ["machine.override.kinematics.warp"],
        ),
        ("[machine]\n", "[machine]\nwarp = 9\n", ["machine.warp", "unknown key"]),
        (
            'source = "classical',
            'sauce = "x", source = "classical',
            ["options.counterweight-half.share_ratio", "unknown key sauce"],
        ),
    ],
)
def test_unknown_key(tree, old, new, words):
    says(refuse_study(tree, old, new), "copeland_thesis.toml", *words)


def test_unknown_key_of_the_machine(tree):
    message = refuse_machine(tree, "[oldham]", "[oldham]\nwarp = { value = 1, source = 'x' }")
    says(message, "copeland_zp41k3e.toml", "oldham.warp", "unknown key")


@pytest.mark.parametrize(
    ("old", "words"),
    [
        ("catalogue_receiver = ", ["catalogue_receiver"]),
        ("tuned_speed_rpm = { value = 3500.0, source = \"assumed: as spring-mass\"",
         ["options.spring-mass-printed.lost_tuned", "did you mean tuned_speed_rpm"]),
        ("damping_ns_per_m", ["options.damping.lost", "did you mean damping_ns_per_m"]),
        ("maximum_frequency_hz", ["radiation"]),
    ],
)  # fmt: skip
def test_missing_key(tree, old, words):
    """A missing value, or one under a key in no known unit."""
    message = refuse_study(tree, old, "lost_" + old)
    says(message, "copeland_thesis.toml", *words)
    assert "missing" in message or "unknown key" in message


@pytest.mark.parametrize("key", ["", " ", "\t"])
def test_a_blank_key_is_shown(tree, key):
    shown = '"\\t"' if key == "\t" else f'"{key}"'
    root = make_tree(tree / "changed")
    for path in (("motor", "auxiliary_resistance_ohm", "source"), ("motor",)):
        with pytest.raises(ParameterError) as caught:
            load_study(write_changed(root, ("machine", path), key, True))
        message = str(caught.value)
        check_lines(message, root)
        assert shown in message


def test_missing_table(tree):
    start, end = THESIS.index("[operation]"), THESIS.index("[options.none]")
    says(refuse_study(tree, THESIS[start:end], ""), "copeland_thesis.toml", "operation", "missing")


@pytest.mark.parametrize("key", ["x_mm = 1.0", "x_m = 1.0", "x_cm = 1.0"])
def test_duplicate_key_or_unit(tree, key):
    message = refuse_study(tree, "x_mm = -541.3", f"x_mm = -541.3\n{key}")
    says(message, "copeland_thesis.toml")
    assert "twice" in message or "overwrite" in message


def test_duplicate_unit_in_an_override(tree):
    message = refuse_study(
        tree,
        "[machine.override.kinematics]",
        "[machine.override.kinematics]\norbit_radius_m = { value = 0.005, source = 'x' }",
    )
    says(message, "copeland_thesis.toml", "orbit_radius", "twice")


def test_missing_none(tree):
    message = refuse_study(tree, '[options.none]\nkind = "none"', "")
    says(message, "copeland_thesis.toml", "options", "none")


def test_none_of_another_kind(tree):
    message = refuse_study(
        tree, '[options.none]\nkind = "none"',
        '[options.none]\nkind = "ring-damping"\ndamping_ns_per_m = 1.0',
    )  # fmt: skip
    says(message, "copeland_thesis.toml", "options", "none")


def test_unknown_option_kind(tree):
    message = refuse_study(tree, 'kind = "twin-oldham"', 'kind = "antigravity"')
    says(message, "copeland_thesis.toml", "options.twin-oldham", "antigravity", "bias-spring")


def test_unknown_catalogue_receiver(tree):
    message = refuse_study(tree, 'catalogue_receiver = "front_1m"', 'catalogue_receiver = "moon"')
    says(message, "copeland_thesis.toml", "catalogue_receiver", "moon", "front_1m")


def test_unknown_criterion(tree):
    message = refuse_study(tree, "added_mass_kg = {", "beauty = {")
    says(message, "copeland_thesis.toml", "scoring.criteria", "beauty")


# --- types ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("wrong", ['"fast"', "true", "[1.0, 2.0]", "2024-01-01", "{ a = 1 }", "{}"])
@pytest.mark.parametrize(
    ("old", "field"),
    [
        ("damping_ns_per_m = { value = 5.0,", "options.damping.damping_ns_per_m"),
        ("orbit_radius_mm = { value = 6.75,", "kinematics.orbit_radius_mm"),
    ],
)
def test_wrong_type_of_a_quantity(tree, old, field, wrong):
    new = old.split("=")[0] + f"= {{ value = {wrong},"
    says(refuse_study(tree, old, new), "copeland_thesis.toml", field)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("x_mm = -541.3", 'x_mm = "left"', ["receivers.left_1m.x_mm", "left", "mm"]),
        ("x_mm = -541.3", "x_mm = true", ["receivers.left_1m.x_mm", "True"]),
        ("x_mm = -541.3", "x_mm = [1.0]", ["receivers.left_1m.x_mm"]),
        (SAMPLES, f"{SAMPLES}\nmaximum_order = 40.5", ["operation.maximum_order", "40.5"]),
        (SAMPLES, f'{SAMPLES}\nmaximum_order = "40"', ["operation.maximum_order", "40"]),
        ("speed_rpm = [2900.0, 3500.0]", "speed_rpm = 2900.0", ["operation.speed_rpm", "2900"]),
        (
            "speed_rpm = [2900.0, 3500.0]",
            'speed_rpm = [2900.0, "x"]',
            ["operation.speed_rpm", "x"],
        ),
        ("[receivers.left_1m]", "[[receivers.left_1m]]", ["receivers.left_1m"]),
        ('kind = "twin-oldham"', "kind = 3", ["options.twin-oldham"]),
        ("[machine]\n", "[[machine]]\n", ["machine"]),
        ('title = "Copeland', 'title = 3 #"', ["title", "3"]),
    ],
)
def test_wrong_type(tree, old, new, words):
    says(refuse_study(tree, old, new), "copeland_thesis.toml", *words)


@pytest.mark.parametrize(
    ("table", "new"),
    [
        ("machine", 'machine = { value = 1, file = "../data/machines/copeland_zp41k3e.toml" }'),
        (
            "scoring",
            'scoring = { value = 1, published_table = "../data/validation/thesis_table_3.csv" }',
        ),
        ("receivers", "receivers = 3"),
        ("options", "options = []"),
        ("scoring", "scoring = 'none'"),
        ("machine", "machine = 'copeland_zp41k3e.toml'"),
    ],
)
def test_value_in_place_of_a_table(tree, table, new):
    kept, inside = [], False
    for line in THESIS.splitlines():
        if line.startswith("["):
            inside = line.lstrip("[").split("]")[0].split(".")[0] == table
        if not inside:
            kept.append(line)
    path = tree / "pipelines" / "study.toml"
    path.write_text("\n".join([new, *kept]), encoding="utf-8")
    says(refused(path), "study.toml", table)


@pytest.mark.parametrize("new", ["override = 3", "override = { value = 1 }", "override = []"])
def test_override_must_be_a_table(tree, new):
    start = THESIS.index("[machine.override.kinematics]")
    end = THESIS.index("[operation]")
    says(refuse_study(tree, THESIS[start:end], new + "\n"), "copeland_thesis.toml", "override")


# --- values --------------------------------------------------------------------------------------


@pytest.mark.parametrize("number", ["nan", "inf", "-inf"])
@pytest.mark.parametrize(
    ("old", "field", "unit"),
    [
        ("x_mm = -541.3", "receivers.left_1m.x_mm", "mm"),
        ("damping_ns_per_m = { value = 5.0", "options.damping.damping_ns_per_m", "N s/m"),
        ("speed_rpm = [2900.0, 3500.0", "operation.speed_rpm", ""),
    ],
)
def test_not_a_finite_number(tree, old, field, unit, number):
    kept, _ = old.rsplit(" ", 1)
    message = refuse_study(tree, old, f"{kept} {number}")
    says(message, "copeland_thesis.toml", field, number, unit)


@pytest.mark.parametrize("number", ["nan", "inf", "-inf"])
def test_not_a_finite_number_in_the_machine(tree, number):
    message = refuse_machine(tree, "mass_kg = { value = 0.0727", f"mass_kg = {{ value = {number}")
    says(message, "copeland_zp41k3e.toml", "oldham.mass_kg", number, "kg")


def test_integer_too_large_for_a_float(tree):
    says(
        refuse_study(tree, "x_mm = -541.3", f"x_mm = 1{'0' * 400}"),
        "copeland_thesis.toml", "receivers.left_1m.x_mm",
    )  # fmt: skip


def test_integer_of_more_digits_than_python_reads(tree):
    refuse_study(tree, "x_mm = -541.3", f"x_mm = 1{'0' * 5000}")


def test_seed_too_large_to_store(tree):
    """netCDF attributes hold 64 bits: better refused now than after the run."""
    message = refuse_study(tree, "published_table", f"seed = {2**64}\npublished_table")
    says(message, "scoring.seed", str(2**64))


def test_negative_mass(tree):
    message = refuse_machine(tree, "mass_kg = { value = 0.0727", "mass_kg = { value = -0.0727")
    says(message, "copeland_zp41k3e.toml", "oldham.mass_kg", "-0.0727", "kg", "above 0", "to 100")


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        # Metres where millimetres were meant, and the reverse; 67.5 cm.
        ("orbit_radius_m", "6.75", ["6.75 m", "from 0.0001 to 0.05 m"]),
        ("orbit_radius_mm", "0.00675", ["0.00675 mm", "from 0.1 to 50 mm"]),
        ("orbit_radius_cm", "67.5", ["67.5 cm", "from 0.01 to 5 cm"]),
        ("orbit_radius_um", "6.75", ["6.75 µm", "from 100 to 50000 µm"]),
    ],
)
def test_unit_slip(tree, key, value, words):
    message = refuse_study(tree, "orbit_radius_mm = { value = 6.75", f"{key} = {{ value = {value}")
    says(message, "copeland_thesis.toml", f"kinematics.{key}", *words)


def test_a_limit_is_told_in_the_unit_of_the_file_only(tree):
    """`less than or equal to 0.05; allowed from 0.01 to 5 cm` would name two limits."""
    message = refuse_study(
        tree, "orbit_radius_mm = { value = 6.75", "orbit_radius_cm = { value = 67.5"
    )
    assert "0.05" not in message


def test_key_without_a_unit(tree):
    message = refuse_study(tree, "orbit_radius_mm", "orbit_radius")
    says(message, "copeland_thesis.toml", "orbit_radius")


@pytest.mark.parametrize("speed", ["0.0", "-2900.0", "1e9"])
def test_impossible_speed(tree, speed):
    message = refuse_study(tree, "speed_rpm = [2900.0, 3500.0]", f"speed_rpm = [2900.0, {speed}]")
    says(message, "copeland_thesis.toml", "speed_rpm", f"{float(speed):g}", "60 to 60000 rpm")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("speed_rpm = [2900.0, 3500.0]", "speed_rpm = []", ["speed_rpm"]),
        ("speed_rpm = [2900.0, 3500.0]", "speed_rpm = [2900.0, 2900.0]", ["speed_rpm", "twice"]),
        (SAMPLES, f"{SAMPLES}\nmaximum_order = 128", ["maximum_order", "128", "256"]),
        (SAMPLES, "crank_angle_samples = 80\nmaximum_order = 40",
         ["crank_angle_samples = 80", "above 80", "twice maximum_order = 40"]),
        (SAMPLES, f"{SAMPLES}\nmaximum_order = 60", ["maximum_frequency_hz", "3500 Hz"]),
        ("best = 0.0, worst = 15.0", "best = 15.0, worst = 15.0", ["residual_moment_nm", "best"]),
        ("[radiation]\n", "[radiation]\nroom_spacing_mm = 500.0\n",
         ["radiation.room_spacing_mm", "500", "from 5 to 100 mm"]),
        ("[radiation]\n", '[radiation]\nroom_solver = "sea"\n',
         ["radiation.room_solver", "sea", "closed-form"]),
        ("height_mm = 1442.0", "height_mm = -1.0",
         ["receivers.above_1m.height_mm", "-1", "from 0 to 20000 mm"]),
    ],
)  # fmt: skip
def test_value_that_cannot_be(tree, old, new, words):
    says(refuse_study(tree, old, new), "copeland_thesis.toml", *words)


@pytest.mark.parametrize(
    ("key", "value", "words"),
    [
        ("lower_height_mm", 30.0, ["counterweights", "upper_height_m"]),
        ("centre_of_mass_height_mm", 500.0, ["shell", "centre_of_mass_height_m", "417"]),
        ("inertia_zz_kg_m2", 1.2, ["housing", "inertia", "1.2 > 0.57 + 0.57 kg m²"]),
    ],
)
def test_machine_that_cannot_be(tree, key, value, words):
    """Values that are each in range but not together."""
    line = next(line for line in MACHINE.splitlines() if line.startswith(f"{key} = "))
    message = refuse_machine(tree, line, f"{key} = {{ value = {value}, source = 'measured' }}")
    says(message, "copeland_zp41k3e.toml", *words)


# --- sources and ranges --------------------------------------------------------------------------


def test_machine_value_without_a_source(tree):
    message = refuse_machine(tree, 'mass_kg = { value = 0.0727, source = "thesis 7.1" }',
                             "mass_kg = 0.0727")  # fmt: skip
    says(message, "copeland_zp41k3e.toml", "oldham.mass_kg", "0.0727", "source")


@pytest.mark.parametrize("source", ["", '""', '"  "', "3"])
def test_quantity_without_a_source(tree, source):
    new = "mass_kg = { value = 0.0727" + (f", source = {source}" if source else "") + " }"
    message = refuse_machine(tree, 'mass_kg = { value = 0.0727, source = "thesis 7.1" }', new)
    says(message, "copeland_zp41k3e.toml", "oldham.mass_kg", "source is missing")


def test_assumed_value_without_a_range(tree):
    message = refuse_study(tree, 'oiled slider", range = [0.002, 0.05]', 'oiled slider"')
    says(message, "copeland_thesis.toml", "options.spring-mass.damping_ratio", "range")


def test_value_outside_its_own_range(tree):
    message = refuse_study(
        tree, "damping_ns_per_m = { value = 5.0", "damping_ns_per_m = { value = 50.0"
    )
    says(message, "copeland_thesis.toml", "options.damping.damping_ns_per_m", "50 N s/m", "1 to 20")


@pytest.mark.parametrize(
    "limits", ["[1.0]", "3", "[1.0, nan]", '["a", "b"]', "[1, 2, 3]", "[9.0, 1.0]"]
)
def test_range_that_is_none(tree, limits):
    message = refuse_study(tree, "range = [1.0, 20.0]", f"range = {limits}")
    says(message, "copeland_thesis.toml", "options.damping.damping_ns_per_m", "range")


# --- anything at all -----------------------------------------------------------------------------

anything = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.integers(min_value=10**300, max_value=10**320)
    | st.floats()
    | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3)
    | st.dictionaries(st.text(max_size=4), inner, max_size=3),
    max_leaves=5,
)  # fmt: skip


@pytest.fixture(scope="module")
def module_tree(tmp_path_factory) -> Path:
    return make_tree(tmp_path_factory.mktemp("studies"))


# One change is small as it is, and shrinking it takes minutes.
UNSHRUNK = (Phase.explicit, Phase.reuse, Phase.generate)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*usual is")  # an unusual value loads, with a warning
@settings(max_examples=20, deadline=None, phases=UNSHRUNK)
@given(place=st.sampled_from(PATHS), value=anything, rename=st.booleans())
def test_any_value_anywhere_loads_or_is_refused_in_lines(module_tree, place, value, rename):
    """Replace, remove or rename one value or table of the study or of its machine."""
    path = write_changed(module_tree, place, value, rename)
    message = None
    try:
        load_study(path)
    except ParameterError as error:
        message = str(error)
    if message is not None:
        check_lines(message, module_tree)


@pytest.mark.parametrize("newline", ["\\n", "\\r\\n", "\\u2028"])
def test_line_breaks_in_keys_and_values_do_not_break_the_message(tree, newline):
    refuse_study(tree, "[operation]", f'["a{newline}b"]\nx = 1\n[operation]')
    refuse_study(tree, "x_mm = -541.3", f'x_mm = "a{newline}b"')


def test_deep_nesting(tree):
    path = tree / "pipelines" / "study.toml"
    path.write_text(".".join(["a"] * 5000) + " = 1\n" + THESIS, encoding="utf-8")
    refused(path)
