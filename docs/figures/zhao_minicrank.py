"""Draw docs/figures/zhao_minicrank.svg: the linkage, three mini-cranks, torque over a revolution.

The linkages are drawn with cranks of a quarter of the scroll's link; the real ones have a 26th.
"""

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import vibroacoustics as va

HERE = Path(__file__).resolve().parent
MACHINE = HERE.parent.parent / "data" / "machines" / "zhao_minicrank.toml"
CRANK_ANGLE = np.deg2rad(65.0)
CRANK_LENGTH, SCROLL_LENGTH, MINICRANK_LENGTH, BRACKET_LENGTH = 0.25, 1.0, 0.26, 1.0
CRANK, SCROLL, MINICRANK, FRAME = "#d55e00", "#0072b2", "#009e73", "0.35"


def main() -> None:
    mpl.rcParams.update({"svg.hashsalt": "vibroacoustics", "font.size": 9.0})
    figure = Figure(figsize=(11.0, 3.6), layout="constrained")
    one, three, torque = figure.subplots(1, 3, width_ratios=[2.0, 1.0, 1.3])
    draw_four_bar(one)
    draw_three(three)
    draw_torque(torque)
    figure.savefig(HERE / "zhao_minicrank.svg", metadata={"Date": None})


def draw_four_bar(axes: Axes) -> None:
    pin = CRANK_LENGTH * np.exp(1j * CRANK_ANGLE)
    third = minicrank_angle(pin)
    far = BRACKET_LENGTH + MINICRANK_LENGTH * np.exp(1j * third)
    line(axes, 0.0, BRACKET_LENGTH, FRAME, linestyle="--")
    for start, end, colour in (
        (0.0, pin, CRANK),
        (pin, far, SCROLL),
        (BRACKET_LENGTH, far, MINICRANK),
    ):
        line(axes, start, end, colour, linewidth=4.0, solid_capstyle="round")
    for place in (0.0, pin, far, BRACKET_LENGTH):
        axes.plot(np.real(place), np.imag(place), "o", color="white", mec="black", ms=6.0)
    forward = 1j * np.exp(1j * CRANK_ANGLE)
    arrow(axes, pin, pin - 0.22 * forward, "$F_t$")
    outward = np.exp(1j * CRANK_ANGLE)
    arrow(axes, pin + 0.2 * outward, pin + 0.03 * outward, "")
    beyond = pin + 0.25 * outward
    axes.text(beyond.real, beyond.imag, "$F_r$", ha="center", va="center")
    for place, text, aligned in (
        (0.5 * pin - 0.06, "$l_1$ crankshaft", "right"),
        (0.5 * (pin + far) + 0.06j, "$l_2$ orbiting scroll, $J_2$", "center"),
        (0.5 * (BRACKET_LENGTH + far) - 0.06, "$l_3$ mini-crank", "right"),
        (0.5 - 0.06j, "$l_4$ bracket", "center"),
    ):
        axes.text(np.real(place), np.imag(place), text, ha=aligned, va="center")
    for centre, end, name in ((0.0, CRANK_ANGLE, "1"), (BRACKET_LENGTH, third, "3")):
        arc = centre + 0.09 * np.exp(1j * np.linspace(0.0, end, 30))
        axes.plot(arc.real, arc.imag, color="black", linewidth=0.8)
        label = centre + 0.13 * np.exp(0.4j * end)
        axes.text(label.real, label.imag, rf"$\theta_{name}$", va="center")
    arrow(axes, -0.25 - 0.22j, -0.1 - 0.22j, "x")
    arrow(axes, -0.25 - 0.22j, -0.25 - 0.07j, "z")
    axes.set(xlim=(-0.45, 1.25), ylim=(-0.3, 0.55), title="One rigid mini-crank, as Zhao draws it")
    axes.set_aspect("equal")
    axes.axis("off")


def minicrank_angle(pin: complex) -> float:
    """Angle at which scroll and mini-crank meet, by the law of cosines."""
    span = pin - BRACKET_LENGTH
    cosine = (MINICRANK_LENGTH**2 + abs(span) ** 2 - SCROLL_LENGTH**2) / (
        2.0 * MINICRANK_LENGTH * abs(span)
    )
    return float(np.angle(span) - np.arccos(cosine))


def draw_three(axes: Axes) -> None:
    pin = CRANK_LENGTH * np.exp(1j * CRANK_ANGLE)
    centres = np.exp(2j * np.pi * np.arange(3) / 3.0)
    around = np.exp(1j * np.linspace(0.0, 2.0 * np.pi, 200))
    plate = pin + 1.22 * around
    axes.fill(plate.real, plate.imag, color=SCROLL, alpha=0.12)
    line(axes, 0.0, pin, CRANK, linewidth=4.0, solid_capstyle="round")
    for centre in centres:
        line(axes, pin, centre + pin, SCROLL, linewidth=2.0)
        line(axes, centre, centre + pin, MINICRANK, linewidth=4.0, solid_capstyle="round")
    for place in (0.0, pin, *centres, *(centres + pin)):
        axes.plot(np.real(place), np.imag(place), "o", color="white", mec="black", ms=5.0)
    axes.set(title="Three mini-cranks at 120°")
    axes.set_aspect("equal")
    axes.axis("off")


def draw_torque(axes: Axes) -> None:
    machine = va.load_machine(MACHINE)
    styles = ("-", "--", "-.", ":")
    for error_um, style in zip((-10.0, -50.0, -100.0, 0.0), styles, strict=True):
        changed = machine.four_bar.model_copy(update={"crank_error_m": 1e-6 * error_um})
        inner = va.curves(machine.model_copy(update={"four_bar": changed}), 1500.0)
        total = inner["input_torque"].sel(torque_of="all")
        label = f"{error_um:g} µm".replace("-", "−") if error_um else "none: (18)"
        axes.plot(np.rad2deg(total["crank_angle"]), total, style, label=label, linewidth=1.2)
    axes.set(
        xlim=(0.0, 360.0),
        xticks=range(0, 361, 60),
        xlabel=r"crank angle $\theta_1$, degrees",
        ylabel="input torque, N m",
        title="One rigid mini-crank, 1500 rpm",
    )
    axes.legend(title="error of $l_1$", loc="lower center")


def line(axes: Axes, start: complex, end: complex, colour: str, **style: object) -> None:
    axes.plot([np.real(start), np.real(end)], [np.imag(start), np.imag(end)], color=colour, **style)


def arrow(axes: Axes, start: complex, end: complex, text: str) -> None:
    tip, foot = (np.real(end), np.imag(end)), (np.real(start), np.imag(start))
    axes.annotate("", tip, foot, arrowprops={"arrowstyle": "-|>", "color": "black"})
    beyond = end + 0.05 * (end - start) / abs(end - start)
    axes.text(np.real(beyond), np.imag(beyond), text, ha="center", va="center")


if __name__ == "__main__":
    main()
