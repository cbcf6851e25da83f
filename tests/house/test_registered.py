"""Registered options, machines and criteria: dumps, hashes, schema, words."""

import json

import numpy as np
import pytest
from support import PIPELINES, ROOT, steady

from vibroacoustics.base.parameters import split_kind
from vibroacoustics.base.plain_bytes import canonical_json, sha256
from vibroacoustics.machine.machine import MACHINES
from vibroacoustics.machine.option import OPTIONS
from vibroacoustics.study.criterion import CRITERIA
from vibroacoustics.study.loading import load_machine, load_study
from vibroacoustics.study.study import Study

STUDIES = sorted(PIPELINES.glob("*.toml"))
MACHINE_FILES = sorted(
    file
    for file in (ROOT / "data" / "machines").glob("*.toml")
    if 'kind = "' in file.read_text(encoding="utf-8")
)
every_kind = pytest.mark.parametrize("kind", OPTIONS)


@pytest.fixture(scope="module")
def examples():
    """One option of every kind, from the studies where they have one."""
    machine = load_machine(ROOT / "data" / "machines" / "copeland_zp41k3e.toml")
    twin = {"mass_kg": 0.07, "stroke_ratio": 1.0, "distance_below_ring_m": 0.2}
    found = {
        "torsion-spring": OPTIONS["torsion-spring"](preload_n_m=2.0, twin=twin),
        "bias-spring": OPTIONS["bias-spring"](preload_n=5.0, stiffness_n_per_m=1e3, twin=twin),
        "counterweight": OPTIONS["counterweight"](
            mass_kg=0.1, radius_m=0.02, angle_rad=np.pi, height_m=0.0
        ),
        "hood": OPTIONS["hood"](band_hz=(500.0, 630.0), insertion_loss_db=(3.0, 5.0)),
        "redesign": OPTIONS["redesign"](machine=machine),
    }
    for file in STUDIES:
        for option in load_study(file).options.values():
            found.setdefault(option.kind, option)
    return found


@pytest.fixture
def option(kind, examples):
    return examples[kind]


def test_every_registered_thing_is_tested_here(examples):
    assert set(examples) == set(OPTIONS)
    assert {load_machine(file).kind for file in MACHINE_FILES} == set(MACHINES)


@every_kind
def test_a_dump_of_an_option_gives_it_back(option):
    kind, values = split_kind(OPTIONS, option.model_dump())
    assert kind.model_validate(values) == option
    kind, values = split_kind(OPTIONS, json.loads(option.model_dump_json()))
    assert kind.model_validate_json(json.dumps(values)) == option


@every_kind
def test_options_that_differ_in_one_value_differ_in_dump_and_hash(option):
    before = canonical_json(option.model_dump(mode="json"))
    for name in type(option).model_fields:
        value = getattr(option, name)
        if isinstance(value, float):
            other = option.model_copy(update={name: value + 1e-9})
            after = canonical_json(other.model_dump(mode="json"))
            assert after != before, name
            assert sha256(after.encode()) != sha256(before.encode())


@pytest.mark.parametrize("file", MACHINE_FILES, ids=lambda file: file.stem)
def test_a_dump_of_a_machine_gives_it_back(file):
    machine = load_machine(file)
    kind, values = split_kind(MACHINES, machine.model_dump())
    assert kind.model_validate(values) == machine
    kind, values = split_kind(MACHINES, json.loads(machine.model_dump_json()))
    assert kind.model_validate_json(json.dumps(values)) == machine


@pytest.mark.parametrize("file", STUDIES, ids=lambda file: file.stem)
def test_a_dump_of_a_study_gives_it_back(file):
    study = load_study(file)
    assert Study.model_validate(study.model_dump()) == study
    assert Study.model_validate_json(study.model_dump_json()) == study
    options = study.parameters()["options"]
    assert {name: table["kind"] for name, table in options.items()} == {
        name: option.kind for name, option in study.options.items()
    }


def test_schema_of_a_study_is_the_union_of_what_is_registered():
    schema = json.dumps(Study.model_json_schema())
    for kind in (*OPTIONS, *MACHINES):
        assert f'{{"const": "{kind}"}}' in schema, kind


@every_kind
def test_every_option_reports_its_mass_and_has_words(option, thesis_study, derived_study):
    machine = thesis_study.machine
    if option.kind == "spring-mass-printed":
        machine = derived_study.machine  # both scrolls have the ring it was tuned for
    added = option.added(machine, steady(3500.0))
    assert "added_mass_kg" in added.figures
    figures = {name: np.array([value]) for name, value in added.figures.items()}
    for text in (*option.sentences(figures), *option.leaves_out(False), *option.leaves_out(True)):
        assert text.endswith(".")
    assert set(option.labels) <= set(added.figures) | {
        "twin_key_impacts_per_revolution",  # these two come with keys
        "twin_key_force_peak_n",
    }


@pytest.mark.parametrize("file", MACHINE_FILES, ids=lambda file: file.stem)
def test_every_kind_of_machine_has_words_of_its_own(file):
    machine = load_machine(file)
    for inner_sources in (False, True):
        assert all(text.endswith(".") for text in machine.leaves_out(inner_sources))
    assert machine.leaves_out(False)
    assert machine.axes
    assert machine.orders.endswith(".")


def test_every_criterion_has_words_and_unit():
    for name, criterion in CRITERIA.items():
        assert criterion.label, name
        assert criterion.unit, name
