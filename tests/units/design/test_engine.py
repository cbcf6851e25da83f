"""Designs by linear algebra agree with plain runs, and what is not linear is run."""

from typing import ClassVar

import numpy as np
import pytest
from design_studies import (
    LEFT,
    WEIGHT,
    design_table,
    engine_of,
    largest_difference_db,
    study_with,
)
from support import PIPELINES

from vibroacoustics.base.registry import register
from vibroacoustics.design.engine.needs import Need
from vibroacoustics.machine.option import Option
from vibroacoustics.mechanics.added import Added
from vibroacoustics.mechanics.bushings import AttachedBodies, Bushing, RigidBody
from vibroacoustics.mechanics.moving_parts import circling
from vibroacoustics.transfer import on_mounts

CLOSE_DB = 1e-9
DESIGNS = 2
VARIABLES = {
    "options.weight.mass_g": "range = [1, 100]",
    "options.weight.radius_mm": "range = [5, 40]",
    "options.weight.angle_deg": "range = [-180, 180]",
    "options.weight.height_mm": "range = [-100, 100]",
}
MOUNTS = {
    "machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 50]",
    "machine.mounts.lateral_stiffness_n_per_mm": "range = [5, 50]",
    "machine.mounts.loss_factor_ratio": "range = [0.02, 0.3]",
    "machine.mounts.pitch_mm": "range = [150, 250]",
}


def routes(engine, option):
    return {key: route.linear for key, route in engine.routes(option).items()}


@pytest.mark.long
def test_counterweights_of_the_scroll_compressor():
    study = study_with(LEFT + WEIGHT + design_table('"weight"', VARIABLES))
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", DESIGNS)) < CLOSE_DB
    assert all(routes(engine, "weight").values())
    assert engine.routes("weight")["options.weight.angle_deg"].reason == "an angle"


@pytest.mark.long
def test_mounts_of_the_scroll_compressor():
    study = study_with(LEFT + WEIGHT + design_table('"weight"', {**VARIABLES, **MOUNTS}))
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", DESIGNS)) < CLOSE_DB
    assert all(routes(engine, "weight").values())


def test_feet_and_lanchester_of_a_machine_by_table():
    variables = {
        "options.lanchester.share_ratio": "range = [0, 2]",
        "options.lanchester.radius_mm": "range = [20, 90]",
        "machine.feet.foot_4.y_mm": "range = [200, 300]",
        "machine.feet.foot_4.x_mm": "range = [-100, 100]",
        "machine.housing.mass_kg": "range = [200, 300]",
    }
    study = study_with(
        design_table('"lanchester"', variables), PIPELINES / "reciprocating_table.toml"
    ).replace({"operation.speed_rpm": [950.0], "operation.maximum_order": 6})
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", DESIGNS)) < CLOSE_DB
    assert engine.routes("lanchester")["options.lanchester.radius_mm"].reason == "inverse"
    assert all(routes(engine, "lanchester").values())


SPRUNG = """
[options.sprung]
kind = "spring-mass"
stiffness_n_per_mm = 3.255
tuned_speed_rpm = 3500.0
damping_ratio = 0.01
height_below_ring_mm = 25.0
"""


def test_sprung_masses_by_their_closed_form():
    variables = {
        "options.sprung.stiffness_n_per_mm": "range = [1, 3]",
        "options.sprung.tuned_speed_rpm": "range = [2800, 3600]",
        "options.sprung.damping_ratio": "range = [0.001, 0.1]",
        "options.sprung.height_below_ring_mm": "range = [-50, 50]",
    }
    study = study_with(SPRUNG + design_table('"sprung"', variables))
    needs = (Need("sound"), Need("foot", 1), Need("figure", None, "stroke_amplitude_mm"),
             Need("figure", None, "resonance_speed_rpm"))  # fmt: skip
    engine = engine_of(study, needs)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", DESIGNS)) < CLOSE_DB
    assert all(routes(engine, "sprung").values())


def test_pendulums_take_runs_and_mounts_do_not():
    pendulum = """
[options.pendulum]
kind = "pendulum"
length_mm = 25.0
horizontal_reach_mm = 15.0
damping_ratio = 0.02
"""
    variables = {
        "options.pendulum.length_mm": "range = [20, 40]",
        "machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 50]",
    }
    study = study_with(pendulum + design_table('"pendulum"', variables))
    engine = engine_of(study)
    designs = engine.space.sample("sobol", 64)
    designs[1:, 0] = designs[1, 0]  # of one length: by linear algebra
    seen = engine.outcome(designs).results[Need("sound")]
    assert largest_difference_db(engine, study, designs[:2]) < CLOSE_DB  # by runs
    np.testing.assert_allclose(
        engine.outcome(designs[:2]).results[Need("sound")], seen[:2], rtol=1e-11
    )
    assert list(routes(engine, "pendulum").values()) == [False, True]


@pytest.mark.long
@pytest.mark.filterwarnings("ignore:.*usual is")
def test_choice_among_options():
    variables = {**VARIABLES, "options.counterweight-half.share_ratio": "range = [0, 1]"}
    table = design_table('["none", "weight", "counterweight-half"]', variables)
    study = study_with(WEIGHT + table)
    engine = engine_of(study)
    designs = engine.space.sample("latin-hypercube", 3)
    assert set(designs[:, 0]) == {0.0, 1.0, 2.0}
    assert largest_difference_db(engine, study, designs) < CLOSE_DB
    assert all(routes(engine, "weight").values())
    assert all(routes(engine, "none").values())


class Absorber(Option):
    """A mass on a spring with a dashpot at a corner of the housing."""

    kind: ClassVar[str] = "absorber"
    mass_kg: float
    stiffness_n_per_m: float
    damping_ns_per_m: float

    def attached(self, machine):
        point, held = np.array([0.1, 0.02, 0.1]), np.array([1.0, 1.0, 1.0, 1e-2, 1e-2, 1e-2])
        body = RigidBody("absorber", self.mass_kg, 1e-3 * np.eye(3), point)
        spring = Bushing(
            "dashpot", "absorber", "housing", point,
            self.stiffness_n_per_m * np.diag(held), self.damping_ns_per_m * np.diag(held),
        )  # fmt: skip
        return AttachedBodies((body,), (spring,))


@pytest.fixture
def absorber():
    register(Absorber)


def test_attached_bodies_move_in_designs_as_in_runs(absorber):
    """Natural frequencies too, which the dashpot leaves as they are."""
    text = '[options.absorber]\nkind = "absorber"\nmass_kg = 0.5\n'
    text += "stiffness_n_per_m = 5e4\ndamping_ns_per_m = 8.0\n"
    variables = {
        "options.absorber.mass_kg": "range = [0.2, 1.0]",
        "options.absorber.stiffness_n_per_m": "range = [1e4, 1e5]",
        "options.absorber.damping_ns_per_m": "range = [0.0, 20.0]",
        "machine.mounts.loss_factor_ratio": "range = [0.02, 0.3]",
    }
    study = study_with(text + design_table('"absorber"', variables))
    engine = engine_of(study)
    designs = engine.space.sample("sobol", DESIGNS)
    assert largest_difference_db(engine, study, designs) < CLOSE_DB
    assert all(routes(engine, "absorber").values())
    natural = engine_of(study, (Need("natural"),)).outcome(designs[:1]).results[Need("natural")]
    changed = study.replace(engine.space.written(designs[0]))
    machine = changed.options["absorber"].built_into(changed.machine)
    body = on_mounts(machine)
    assert machine.body_names == tuple(one.name for one in body.isolation.bodies)
    expected = body.natural_modes()[0]
    assert expected.size == 12
    np.testing.assert_allclose(natural[0], expected, rtol=0.0, atol=1e-9 * expected.max())


class Kinked(Option):
    """A weight that a stop holds at a radius."""

    kind: ClassVar[str] = "kinked"
    radius_m: float
    mass_kg: float

    def added(self, machine, revolution):
        radius = min(self.radius_m, 0.031)
        angle = revolution.rotation.crank_angle
        part = circling("balancer", self.mass_kg, radius, 0.0, angle)
        return Added((part,), {"added_mass_kg": self.mass_kg})


@pytest.fixture
def kinked():
    register(Kinked)


def test_what_only_looks_linear_takes_runs(kinked):
    text = '[options.kinked]\nkind = "kinked"\nradius_m = 0.02\nmass_kg = 0.1\n'
    variables = {
        "options.kinked.radius_m": "range = [0.001, 0.04]",
        "options.kinked.mass_kg": "range = [0.01, 0.1]",
    }
    study = study_with(text + design_table('"kinked"', variables))
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", DESIGNS)) < CLOSE_DB
    assert routes(engine, "kinked") == {
        "options.kinked.radius_m": False,
        "options.kinked.mass_kg": True,
    }


def test_chunks_and_order_of_designs_change_nothing(monkeypatch):
    from vibroacoustics.design.engine import joined_designs

    free = "machine.mounts.lateral_stiffness_n_per_mm"
    variables = {"options.weight.mass_g": "range = [1, 100]", free: MOUNTS[free]}
    engine = engine_of(study_with(WEIGHT + design_table('"weight"', variables)), (Need("sound"),))
    designs = engine.space.sample("sobol", 64)
    together = engine.outcome(designs).results[Need("sound")]
    monkeypatch.setattr(joined_designs, "CHUNK_BYTES", 1.0)
    one_by_one = engine.outcome(designs[::-1]).results[Need("sound")][::-1]
    np.testing.assert_allclose(one_by_one, together, rtol=1e-13)
