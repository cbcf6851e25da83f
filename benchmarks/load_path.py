"""Frame beside an independent computation, for docs/load_path.md: a figure in docs/figures.

    python benchmarks/load_path.py [--quick]

The quick form writes no figure.
"""

import matplotlib.pyplot as plt
import numpy as np
from quick import ROOT, parser

import vibroacoustics as va
from vibroacoustics.machine.frame import PARTS, Frame
from vibroacoustics.machine.machine import Machine
from vibroacoustics.transfer.frame.of_machine import frame_on_shell
from vibroacoustics.transfer.path import ShellPath
from vibroacoustics.transfer.study_path import computed_shell_path

FIXED_SCROLL, BEARING_HOUSING, ORBITING_SCROLL, LOWER_BEARING, _ = range(len(PARTS))
FREQUENCY, QUICK_FREQUENCY = np.arange(20.0, 4000.0, 8.0), np.array([50.0, 300.0])
ELSEWHERE = {
    "weld": ([50, 300, 500, 700, 1000, 1500, 2000, 3000, 4000],
             [0.19, 0.36, 1.1, 8.1, 3.1, 1.3, 1.4, 0.48, 0.43]),
    "lower": ([50, 300, 500, 700, 1000, 1500, 2000, 3000, 4000],
              [0.19, 0.34, 5.4, 1.5, 0.05, 0.07, 0.15, 0.10, 0.17]),
}  # fmt: skip
"""An independent computation of the same equations on a shell model of its own: Hz, N per N."""


def main() -> None:
    """Forces on the welds and at the lower bearing per newton of a lateral pair on the scrolls."""
    quick = parser(__doc__).parse_args().quick
    hertz = QUICK_FREQUENCY if quick else FREQUENCY
    study = va.load_study(ROOT / "pipelines" / "copeland_sources.toml")
    if quick:
        study = study.replace({"radiation.maximum_frequency_hz": 800.0})
    path = computed_shell_path(study)
    bolted = study.machine.table(Frame).model_copy(update={"axially_compliant": False})
    without = study.machine.model_copy(update={"frame": without_stator(bolted)})
    figure, panels = plt.subplots(1, 2, figsize=(9.6, 3.8), sharey=True, layout="constrained")
    for machine, label, colour in (
        (without, "stator left out", "#8a9aa8"),
        (study.machine, "machine as given", "#d55e00"),
    ):
        forces = lateral_forces(machine, path, hertz)
        for axes, part in zip(panels, (BEARING_HOUSING, LOWER_BEARING), strict=True):
            axes.loglog(hertz, np.abs(forces[part]), color=colour, label=label)
    for axes, name, title in zip(
        panels, ("weld", "lower"), ("bearing housing's welds", "lower bearing's legs"), strict=True
    ):
        axes.plot(
            *ELSEWHERE[name], "o", color="#22303c", ms=4, label="computed elsewhere, no stator"
        )
        axes.set(xlabel="Hz", title=f"Sum of the forces on the {title}", ylim=(0.02, 120.0))
        axes.axhline(1.0, color="#5b7f9f", lw=1, ls=":")
        axes.grid(alpha=0.3)
    panels[0].set_ylabel("N per N of the pair")
    panels[0].legend(fontsize=8)
    if quick:
        print(f"{hertz} Hz: {np.abs(forces[BEARING_HOUSING]).round(3)} N per N on the welds")
        plt.close(figure)
        return
    figure.savefig(
        ROOT / "docs" / "figures" / "load_path.png", dpi=110, metadata={"Software": None}
    )


def without_stator(frame: Frame) -> Frame:
    """The frame with a stator that weighs nothing and that nothing holds."""
    stator = frame.stator.model_copy(update={"mass_kg": 1e-3})
    contacts = frame.contacts.model_copy(update={"land_n_per_m": 0.0})
    return frame.model_copy(update={"stator": stator, "contacts": contacts})


def lateral_forces(machine: Machine, path: ShellPath, hertz: np.ndarray) -> np.ndarray:
    """Force along x of each part on the shell, shape (part, frequency)."""
    on_shell = frame_on_shell(machine, path)
    height = machine.table(Frame).wraps_height_m
    load = np.zeros((len(PARTS), 6))
    load[FIXED_SCROLL, [0, 4]] = 1.0, height
    load[ORBITING_SCROLL, [0, 4]] = -1.0, -height
    forces = on_shell.contact_forces(hertz) @ load.ravel()
    along_x = forces * on_shell.contacts.rigid[:, 0]
    return np.array(
        [along_x[:, on_shell.contacts.part == p].sum(axis=1) for p in range(len(PARTS))]
    )


if __name__ == "__main__":
    main()
