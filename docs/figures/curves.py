"""Draw the inner curves that docs/machines shows, with the printed numbers: docs/figures/curves.

Run in the repository's root: python docs/figures/curves.py
"""

import io
from collections.abc import Callable
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

import vibroacoustics as va

ROOT = Path(__file__).parents[2]
FOLDER = Path(__file__).with_suffix("")
PRINTED = {"color": "#7a5195", "zorder": 5}
COLOURS = 48

SHOWN = {
    "pipelines/copeland_sources.toml": (
        "pocket_pressure", "gas_force", "gas_force_angle", "key_force", "whirl_frequency",
        "critical_speed",
    ),
    "data/machines/mayekawa_wbhe.toml": (
        "crank_acceleration", "friction_torque", "friction_loss", "mechanical_efficiency",
        "best_design",
    ),
    "data/machines/zhao_minicrank.toml": (
        "ideal_input_torque", "input_torque", "input_torque_by_error",
    ),
    "data/machines/dagilis_slider_link.toml": (
        "friction_moment", "friction_force", "friction_coefficient", "friction_power",
    ),
    "data/machines/estupinan_hermetic.toml": (
        "joint_force", "upper_bearing_force", "journal_orbit", "thinnest_film",
        "highest_film_pressure", "whirl_frequency",
    ),
}  # fmt: skip
AS_PRINTED = {"operation.point": None, "machine.gas.opening_law": "equalisation-angle"}
"""Of a study: the thesis's pressures."""
SPEEDS = {"data/machines/zhao_minicrank.toml": 1500.0}


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    for file, names in SHOWN.items():
        path = ROOT / file
        is_study = "machines" not in file
        shown = va.load_study(path).replace(AS_PRINTED) if is_study else va.load_machine(path)
        inner = va.curves(shown, SPEEDS.get(file))
        for name in names:
            figure = va.plot.curves(inner, name)
            add_printed(path.stem, name, figure)
            save(figure, FOLDER / f"{path.stem}_{name}.png")


def add_printed(machine: str, name: str, figure: Figure) -> None:
    """The printed numbers of a curve, where there are any."""
    if draw := MARKS.get((machine, name)):
        draw(figure.axes[0])


def save(figure: Figure, path: Path) -> None:
    """A small PNG: few colours are enough for lines."""
    content = io.BytesIO()
    figure.savefig(content, format="png")
    image = Image.open(content).convert("RGB")
    image.quantize(COLOURS, dither=Image.Dither.NONE).save(path, optimize=True)


def points(
    x: list[float], y: list[float], at: tuple[float, float] = (0.02, 0.9)
) -> Callable[[Axes], None]:
    def draw(axes: Axes) -> None:
        axes.plot(x, y, "s", mfc="none", ms=9, mew=1.5, clip_on=False, **PRINTED)
        axes.annotate("□ printed", at, xycoords="axes fraction", **PRINTED)

    return draw


def angles(*degrees: float, at: tuple[float, float] = (0.3, 0.9)) -> Callable[[Axes], None]:
    def draw(axes: Axes) -> None:
        for angle in degrees:
            axes.axvline(angle, ls=":", lw=1.2, **PRINTED)
        axes.annotate("⋮ printed", at, xycoords="axes fraction", **PRINTED)

    return draw


def saw_tooth(axes: Axes) -> None:
    axes.plot([0, 180, 180, 360], [-90, 90, -90, 90], lw=1.2, ls=":", label="printed", **PRINTED)
    axes.annotate("⋯ printed", (0.02, 0.9), xycoords="axes fraction", **PRINTED)


def speeds(axes: Axes) -> None:
    for speed in (20932.5, 24974.0):
        axes.axvline(speed, ls=":", lw=1.2, **PRINTED)
    axes.annotate("⋮ printed", (0.46, 0.64), xycoords="axes fraction", **PRINTED)


MARKS: dict[tuple[str, str], Callable[[Axes], None]] = {
    ("copeland_sources", "pocket_pressure"): points([0.0, 480.0], [15.0, 41.159]),
    ("copeland_sources", "gas_force"): angles(90.0, 210.0, at=(0.02, 0.4)),
    ("copeland_sources", "gas_force_angle"): saw_tooth,
    ("copeland_sources", "critical_speed"): speeds,
    ("mayekawa_wbhe", "crank_acceleration"): angles(325.0, at=(0.6, 0.1)),
    ("mayekawa_wbhe", "mechanical_efficiency"): points(
        [120.0, 130.0, 140.0], [92.1, 91.1, 90.3], (0.4, 0.06)
    ),
    ("mayekawa_wbhe", "best_design"): points(
        [800.0, 1000.0, 1200.0, 1000.0], [120.0, 130.0, 140.0, 100.0]
    ),
    ("estupinan_hermetic", "thinnest_film"): angles(295.0),
    ("estupinan_hermetic", "highest_film_pressure"): angles(325.0),
    ("estupinan_hermetic", "whirl_frequency"): points([2980.0] * 2, [1050.0, 6810.0]),
}

if __name__ == "__main__":
    main()
