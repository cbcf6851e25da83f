"""Many random designs of machines of several kinds agree with plain runs."""

import pytest
from design_studies import (
    NEEDS,
    design_table,
    engine_of,
    largest_difference_db,
    study_with,
)
from support import PIPELINES, ROOT

from vibroacoustics.design.engine.seen import Need

CLOSE_DB = 1e-9
WEIGHT = """
[options.weight]
kind = "counterweight"
mass_g = 50.0
radius_mm = 20.0
angle_deg = 180.0
height_mm = 0.0
"""
VARIABLES = {
    "options.weight.mass_g": "range = [1, 400]",
    "options.weight.radius_mm": "range = [5, 40]",
    "options.weight.angle_deg": "range = [-180, 180]",
    "options.weight.height_mm": "range = [-100, 100]",
    "machine.mounts.loss_factor_ratio": "range = [0.02, 0.3]",
    "machine.mounts.lateral_stiffness_n_per_mm": "range = [5, 150]",
    "machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 150]",
}


@pytest.mark.long
@pytest.mark.parametrize(
    "name", ["copeland_thesis", "mayekawa_wbhe", "zhao_minicrank", "dagilis_slider_link"]
)
def test_counterweights_and_mounts(name):
    study = study_with(WEIGHT + design_table('"weight"', VARIABLES), PIPELINES / f"{name}.toml")
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", 16)) < CLOSE_DB
    assert all(route.linear for route in engine.routes("weight").values())


@pytest.mark.long
def test_with_sources_in_an_elastic_shell():
    variables = {
        "options.counterweight-half.share_ratio": "range = [0, 1]",
        "machine.mounts.loss_factor_ratio": "range = [0.02, 0.3]",
        "machine.mounts.vertical_stiffness_n_per_mm": "range = [5, 150]",
    }
    base = ROOT / "tests" / "studies" / "sources_made_up.toml"
    study = study_with(design_table('"counterweight-half"', variables), base)
    engine = engine_of(study, (Need("sound"), Need("sound", 1), *NEEDS[3:]))
    assert largest_difference_db(engine, study, engine.space.sample("sobol", 4)) < CLOSE_DB
    assert all(route.linear for route in engine.routes("counterweight-half").values())
