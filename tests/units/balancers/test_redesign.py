"""Options that change the machine, and Lanchester's balancer, through study files."""

import numpy as np
import pytest
from support import PIPELINES, ROOT, steady

from vibroacoustics.base.errors import ParameterError
from vibroacoustics.mechanics.capabilities import Slider
from vibroacoustics.mechanics.moving_parts import wrench
from vibroacoustics.mechanics.rotation import constant_rotation
from vibroacoustics.orders import order_spectrum
from vibroacoustics.study.loading import load_machine, load_study

STUDY = PIPELINES / "mayekawa_wbhe.toml"


@pytest.fixture(scope="module")
def study():
    return load_study(STUDY)


def refused(tmp_path, old: str, new: str, file=STUDY) -> str:
    text = file.read_text(encoding="utf-8")
    assert text.count(old) == 1
    changed = tmp_path / "study.toml"
    changed.write_text(text.replace(old, new).replace("../data", str(ROOT / "data")))
    with pytest.raises(ParameterError) as caught:
        load_study(changed)
    assert "\n" not in str(caught.value)
    return str(caught.value)


def test_redesign_changes_what_it_names_and_nothing_else(study):
    changed = study.options["lighter-piston"].machine
    assert changed.piston_and_rod.piston_mass_kg == 2.0
    same = changed.model_copy(update={"piston_and_rod": study.machine.piston_and_rod})
    assert same == study.machine


def test_the_change_is_on_record_with_its_source(study):
    fields = {record.field: record for record in study.records}
    record = fields["options.lighter-piston.change.piston_and_rod.piston_mass_kg"]
    assert record.assumed
    assert record.file == "mayekawa_wbhe.toml"


def test_redesign_takes_the_study_s_own_override_over(tmp_path):
    text = STUDY.read_text(encoding="utf-8").replace("../data", str(ROOT / "data"))
    text = text.replace(
        "[operation]",
        '[machine.override.housing]\nmass_kg = { value = 300.0, source = "a test" }\n\n[operation]',
    )
    file = tmp_path / "study.toml"
    file.write_text(text)
    loaded = load_study(file)
    assert loaded.machine.housing.mass_kg == 300.0
    assert loaded.options["lighter-piston"].machine.housing.mass_kg == 300.0


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (
            "{ value = 2.0,",
            "{ value = 1.0,",
            "change.piston_and_rod.piston_mass_kg = 1 kg: outside",
        ),
        ("piston_mass_kg = {", "colour = {", "change.piston_and_rod.colour: the machine has no"),
        ("[options.lighter-piston.change.piston_and_rod]\n", "# ", "change: is missing"),
        ("added_mass_kg = -0.65", "machine = 3", "machine: unknown key"),
    ],
)
def test_bad_redesigns(tmp_path, old, new, words):
    assert f"options.lighter-piston.{words}" in refused(tmp_path, old, new)


def test_ring_option_on_a_machine_without_ring(tmp_path):
    new = '[options.damped]\nkind = "ring-damping"\ndamping_ns_per_m = 5.0\n\n[options.lanchester]'
    message = refused(tmp_path, "[options.lanchester]", new)
    assert "options.damped.kind = ring-damping: needs an Oldham ring" in message
    assert "reciprocating" in message


def test_unknown_kind_of_machine(tmp_path):
    text = (ROOT / "data" / "machines" / "mayekawa_wbhe.toml").read_text(encoding="utf-8")
    file = tmp_path / "machine.toml"
    file.write_text(text.replace('kind = "reciprocating"', 'kind = "rotary"'))
    with pytest.raises(ParameterError, match="kind = rotary: unknown; allowed hermetic"):
        load_machine(file)


def first_order(study, option: str, speed_rpm: float):
    """1x force of what an option adds, along the machine's axes."""
    rotation = constant_rotation(speed_rpm, 64)
    parameters = study.options[option]
    added = parameters.added(study.machine, steady(speed_rpm, 64))
    force, moment = wrench(added.parts, rotation)
    return order_spectrum(force, 3), order_spectrum(moment, 3), added


def test_lanchester_pushes_along_the_stroke_only(study):
    force, moment, added = first_order(study, "lanchester", 1000.0)
    slider = study.machine.require(Slider)
    expected = -slider.mass_kg * slider.amplitude_m * (2.0 * np.pi * 1000.0 / 60.0) ** 2
    assert force[2, 1] == pytest.approx(expected, rel=1e-12)  # the cylinder stands upright
    assert np.max(np.abs(force[:2])) < 1e-12 * abs(expected)
    assert np.max(np.abs(moment)) < 1e-12 * abs(expected)
    assert added.figures["added_mass_kg"] == pytest.approx(
        slider.mass_kg * slider.amplitude_m / 0.05
    )


def test_half_counterweight_turns_against_the_crank_pin(study):
    force, _, _ = first_order(study, "counterweight-half", 1000.0)
    lanchester, _, _ = first_order(study, "lanchester", 1000.0)
    assert force[2, 1] == pytest.approx(0.5 * lanchester[2, 1], rel=1e-12)
    assert force[0, 1] == pytest.approx(-1j * force[2, 1], rel=1e-12)  # a quarter turn later


def test_lanchester_cancels_the_first_order_of_the_piston(study):
    """With all of the rod's mass at the piston nothing of the first order is left."""
    machine = study.machine
    rod = machine.piston_and_rod
    heavy = machine.model_copy(
        update={
            "crankshaft": machine.crankshaft.model_copy(update={"inertia_kg_m2": 1e6}),
            "piston_and_rod": rod.model_copy(
                update={"small_end_to_centre_m": 0.0, "big_end_to_centre_m": rod.rod_length_m}
            ),
        }
    )
    motion = heavy.revolution(1000.0, 720)
    bare = order_spectrum(sum(own.force_n for own in motion.wrenches.values()), 3)
    option = study.options["lanchester"]
    added = option.added(heavy, motion)
    balanced = bare + order_spectrum(wrench(added.parts, motion.rotation).force_n, 3)
    # x_p = r cos θ + l cos φ, and cos φ has even orders only. The speed swings by W/(I Ω²) =
    # 500 J/(1e6 kg m² · 1e4), 5e-8.
    assert abs(balanced[2, 1]) < 1e-7 * abs(bare[2, 1])
    assert abs(balanced[2, 2]) == pytest.approx(abs(bare[2, 2]), rel=1e-6)
