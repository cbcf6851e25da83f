"""A made-up hammer test: a sample of a study's shell is the truth, with noise on its mobilities."""

from dataclasses import replace

import numpy as np
from measured_bench import noisy
from sources_study import SOURCES_STUDY

import vibroacoustics as va
from vibroacoustics.study.measured_shell import MeasuredShell, PartPoint, WallPoint
from vibroacoustics.study.samples import with_sample
from vibroacoustics.transfer.wall_mobility import wall_mobility, wall_of

FREQUENCY = np.arange(300.0, 1801.0, 5.0)
WALL = {
    "w1": WallPoint(node=21, direction="+x", angle_rad=0.35, height_m=0.08),
    "w2": WallPoint(node=22, direction="-x", angle_rad=1.4, height_m=0.0),
    "w3": WallPoint(node=23, direction="+x", angle_rad=3.7, height_m=-0.06),
}
PARTS = {"scroll": PartPoint(node=31, direction="+x", part="fixed_scroll", component="fx")}
_WALLS = {}
REFERENCES = [0, 1, ("fixed_scroll", "fx")]
SETTINGS = MeasuredShell(frequency_responses=("hammer.uff",), wall=WALL, parts=PARTS)


def hammered_study(highest_hz=1800.0):
    """The small study of several sources to a higher frequency."""
    return va.load_study(SOURCES_STUDY).replace({"radiation.maximum_frequency_hz": highest_hz})


def mobilities(study, path, sample, frequency=FREQUENCY):
    """Of a sample's shell, shape (response, reference, frequency)."""
    machine = with_sample(study.machine, study.machine, sample)
    return wall_mobility(machine, path, wall(path), REFERENCES, frequency)


def wall(path):
    """The points, once for each path."""
    if id(path) not in _WALLS:
        angles = np.array([point.angle_rad for point in WALL.values()])
        heights = np.array([point.height_m for point in WALL.values()])
        _WALLS[id(path)] = wall_of(path, angles, heights)
    return _WALLS[id(path)]


def write(file, mobility, share=0.0, number=0, frequency=FREQUENCY):
    """Accelerances of mobilities with noise, one point turned."""
    values = noisy(mobility, share, np.random.default_rng(number))
    forces = [WALL["w1"], WALL["w2"], PARTS["scroll"]]
    functions = []
    for row, response in enumerate(WALL.values()):
        for column, force in enumerate(forces):
            functions.append(
                va.MeasuredFunction(
                    "frequency response", frequency, values[row, column],
                    va.Node(response.node, response.direction),
                    va.Node(force.node, force.direction), "m/s", "N",
                ).with_response_in("m/s²")
            )  # fmt: skip
    turned = [replace(one, values=-one.values, reference=one.reference.opposite)
              for one in functions[:1]]  # fmt: skip
    return va.export_functions([*turned, *functions[1:]], file)


def table(file, **values):
    """Table `measured.shell` of a study, as a file writes it."""
    named = [("wall", WALL), ("parts", PARTS)]
    points = {kind: {name: _written(point) for name, point in each.items()} for kind, each in named}
    return {"frequency_responses": [str(file)], **points, **values}


def _written(point):
    values = point.model_dump()
    if "angle_rad" in values:
        values["angle_deg"] = float(np.degrees(values.pop("angle_rad")))
        values["height_mm"] = 1e3 * values.pop("height_m")
    return values
