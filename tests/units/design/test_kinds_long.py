"""Many random designs of machines of several kinds agree with plain runs."""

import numpy as np
import pytest
from design_studies import (
    NEEDS,
    design_table,
    engine_of,
    largest_difference_db,
    study_with,
)
from support import PIPELINES, ROOT

from vibroacoustics import given_radiation
from vibroacoustics.design.engine.needs import Need
from vibroacoustics.stages.shell import shell_path

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
FEW = {key: VARIABLES[key] for key in (
    "options.weight.mass_g", "options.weight.angle_deg", "machine.mounts.loss_factor_ratio",
)}  # fmt: skip


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "variables"),
    [
        ("copeland_thesis", VARIABLES),
        ("mayekawa_wbhe", VARIABLES),
        ("zhao_minicrank", VARIABLES),
        ("dagilis_slider_link", FEW),  # a revolution takes a second
    ],
)
@pytest.mark.filterwarnings("ignore:.*usual is")
def test_counterweights_and_mounts(name, variables):
    study = study_with(WEIGHT + design_table('"weight"', variables), PIPELINES / f"{name}.toml")
    study = study.replace({"operation.speed_rpm": [study.operation.speed_rpm[0]]})
    engine = engine_of(study)
    assert largest_difference_db(engine, study, engine.space.sample("sobol", 4)) < CLOSE_DB
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
    radiation = made_up_with_modes(study)
    needs = (Need("sound"), Need("sound", 1), *NEEDS[3:])
    engine = engine_of(study, needs, radiation)
    designs = engine.space.sample("sobol", 2)
    assert largest_difference_db(engine, study, designs, radiation) < CLOSE_DB
    assert all(route.linear for route in engine.routes("counterweight-half").values())


def made_up_with_modes(study):
    """Transfer vectors of the housing and of the shell's modes that grow with frequency."""
    frequency = np.arange(25.0, study.radiation.maximum_frequency_hz + 1.0, 25.0)
    generator, modes = np.random.default_rng(3), len(shell_path(study).modes)
    housing, shell = (
        generator.standard_normal((len(study.receivers), count, 1)) * 0.01 * frequency
        for count in (6, modes)
    )
    return given_radiation(housing * (1.0 + 0.5j), frequency, shell * (1.0 - 0.5j))
