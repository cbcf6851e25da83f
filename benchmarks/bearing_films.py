"""Loss factors of pin and journals and oil whirl over the samples, for docs/load_path.md.

python benchmarks/bearing_films.py [--quick]
"""

import numpy as np
from quick import ROOT, parser

import vibroacoustics as va
from vibroacoustics.base.units import shaft_frequency_hz
from vibroacoustics.machine.frame import Frame
from vibroacoustics.mechanics.critical_speed import free_scroll_shaft
from vibroacoustics.mechanics.scroll_shaft import ScrollShaft
from vibroacoustics.study.samples import samples_of, with_sample
from vibroacoustics.transfer.frame.inner import Bearing, bearings_of

FREQUENCY_HZ = np.array([500.0, 700.0])
NAMES = "pin", "main", "lower"
QUANTILES = 0.1, 0.5, 0.9
TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
MIRROR = np.diag([1.0, -1.0])


def main() -> None:
    """Print eccentricity ratio, loss factor and share of samples with oil whirl."""
    study = va.load_study(ROOT / "pipelines" / "copeland_sources.toml")
    if parser(__doc__).parse_args().quick:
        study = study.replace({"uncertainty.random_samples": 4})
    machines = [study.machine]
    samples = samples_of(study).samples
    machines += [with_sample(study.machine, study.machine, sample) for sample in samples]
    every = [(machine, bearings(machine)) for machine in machines]
    for number, name in enumerate(NAMES):
        loss = np.array([loss_factors(each[number]) for _, each in every])
        ratio = np.array([each[number].film.eccentricity_ratio for _, each in every])
        whirl = [whirls(machine, each[number], number) for machine, each in every]
        print(f"{name}: eccentricity {ratio[0]:.2f}", np.quantile(ratio[1:], QUANTILES).round(2))
        print("  loss at 500 and 700 Hz", loss[0].round(3))
        print("  quantiles", np.quantile(loss[1:], QUANTILES, axis=0).T.round(3).tolist())
        print(f"  whirl: nominal {whirl[0]}, of the samples {np.mean(whirl[1:]):.3f}")


def bearings(machine: va.Machine) -> tuple[Bearing, ...]:
    """Bearings of a machine's frame."""
    return bearings_of(machine.table(Frame), free_scroll_shaft(machine.table(ScrollShaft)))


def loss_factors(bearing: Bearing) -> np.ndarray:
    """Imaginary over real part of the dynamic stiffness."""
    flexibility = bearing.flexibility(2.0 * np.pi * FREQUENCY_HZ)
    return -flexibility.imag / flexibility.real


def whirls(machine: va.Machine, bearing: Bearing, number: int) -> bool:
    """Whether a free mass on film and metal whirls, in axes that turn with shaft and load.

    The sleeve turns backwards there: the film is the mirror image of that under a load at rest.
    """
    shaft, frame = machine.table(ScrollShaft), machine.table(Frame)
    share = shaft.rotor_height_m / shaft.main_bearing_height_m
    masses = frame.orbiting_scroll.mass_kg, share * shaft.mass_kg, (1.0 - share) * shaft.mass_kg
    speed = 2.0 * np.pi * shaft_frequency_hz(frame.film_speed_rpm)
    metal, unit, none = bearing.metal_stiffness.real, np.eye(2), np.zeros((2, 2))
    stiffness, damping = (
        MIRROR @ each @ MIRROR for each in (bearing.film.stiffness, bearing.film.damping)
    )
    held = metal / masses[number] * unit
    film = np.linalg.solve(damping, np.hstack([metal * unit, none, -metal * unit - stiffness]))
    states = np.block([[none, unit, none], [speed**2 * unit - held, -2.0 * speed * TURN, held]])
    return bool(np.linalg.eigvals(np.vstack([states, film])).real.max() > 0.0)


if __name__ == "__main__":
    main()
