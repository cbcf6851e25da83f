"""Flank contact that turns with the crank, for docs/load_path.md.

    python benchmarks/turning_flank.py [--quick]

The contact is a spring between the scrolls along the crank: k e eᵀ. On parts that are alike in all
directions it couples a forward line to the backward line two orders below, and nothing else. With
C± the flexibility between the scrolls at orders n ± 1 and P± the loads there, its force at order n
along the crank is exactly N = k (C₊ P₊ + C₋ P₋) / (1 + k (C₊ + C₋) / 2).
"""

import numpy as np
from quick import ROOT, parser
from scipy.linalg import block_diag

import vibroacoustics as va
from vibroacoustics.machine.frame import FIXED_SCROLL, ORBITING_SCROLL, PARTS, Frame
from vibroacoustics.machine.machine import Machine
from vibroacoustics.machine.shell_structure import ShellStructure
from vibroacoustics.mechanics.critical_speed import free_scroll_shaft
from vibroacoustics.mechanics.scroll_shaft import ScrollShaft
from vibroacoustics.study.samples import samples_of, with_sample
from vibroacoustics.transfer.frame.contacts import contacts_of
from vibroacoustics.transfer.frame.inner import inner_set
from vibroacoustics.transfer.frame.of_machine import SHAFT_ELEMENT_M

ORDERS = 82
SAMPLES = 40
STEPS, QUICK_STEPS = 4000, 400
"""Steps of a turn of the small model."""
STIFFNESS_N_PER_M = 1e7, 3e7, 1e8, 3e8, 1e9
BANDS_HZ = (150.0, 355.0), (355.0, 710.0), (710.0, 1420.0), (1420.0, 3550.0), (150.0, 3550.0)


def main() -> None:
    """Print the error in decibel of two models without turning contact, over samples."""
    quick = parser(__doc__).parse_args().quick
    steps = QUICK_STEPS if quick else STEPS
    print("exact solution beside a turn integrated by Runge and Kutta:", check(steps))
    study = va.load_study(ROOT / "pipelines" / "copeland_sources.toml")
    if quick:
        study = study.replace({"uncertainty.random_samples": 4})
    samples = samples_of(study).samples[: 2 if quick else SAMPLES]
    random = np.random.default_rng(1)
    speeds = 2.0 * np.pi * random.uniform(45.0, 60.0, len(samples))
    machines = [with_sample(study.machine, study.machine, sample) for sample in samples]
    for stiffness in STIFFNESS_N_PER_M[: 1 if quick else None]:
        errors = np.array(
            [of_sample(*each, stiffness, random) for each in zip(machines, speeds, strict=True)]
        )
        for band, values in zip(BANDS_HZ, np.moveaxis(errors, 1, 0), strict=True):
            each = np.quantile(values, [0.1, 0.5, 0.9], axis=0).T.round(1).tolist()
            print(f"{stiffness:.0e} N/m, {band} Hz: none {each[0]}, half {each[1]}")


def of_sample(
    machine: Machine, speed: float, stiffness: float, random: np.random.Generator
) -> list[list[float]]:
    """Errors without contact and with half of it in all directions, dB, (band, model)."""
    omega = speed * np.arange(ORDERS + 2)
    omega[0] = 1.0
    without, half = (responses(machine, omega, k) for k in (0.0, 0.5 * stiffness))
    order = np.arange(1, ORDERS + 1)
    tangential = np.exp(2j * np.pi * random.random(ORDERS)) / order**1.5
    forward, backward = 0.5j * tangential, -0.5j * tangential
    contact = contact_force(without[0], stiffness, forward, backward)
    levels = []
    for model, force in ((without, contact), (without, 0.0), (half, 0.0)):
        squares = np.zeros(ORDERS + 2)
        squares[2:] += np.abs(model[1, 2:] * (forward - 0.5 * force)) ** 2
        squares[:-2] += np.abs(model[1, :-2] * (backward - 0.5 * force)) ** 2
        hertz = omega / (2.0 * np.pi)
        sums = [squares[(hertz >= low) & (hertz < high)].sum() for low, high in BANDS_HZ]
        levels.append(10.0 * np.log10(sums))
    return np.stack([levels[1] - levels[0], levels[2] - levels[0]], axis=1).tolist()


def contact_force(
    flexibility: np.ndarray, stiffness: float, forward: np.ndarray, backward: np.ndarray
) -> np.ndarray:
    """Force of the contact along the crank at orders 1 and up, N.

    Parameters
    ----------
    flexibility : between the scrolls at orders 0 and up, m/N
    stiffness : of the contact
    forward, backward : loads one order above and below, N
    """
    above, below = flexibility[2:], flexibility[:-2]
    moved = above * forward + below * backward
    return stiffness * moved / (1.0 + 0.5 * stiffness * (above + below))


def responses(machine: Machine, omega: np.ndarray, stiffness: float) -> np.ndarray:
    """Motion between the scrolls and force on a wall at rest per lateral pair, (2, frequency)."""
    frame, shaft = machine.table(Frame), machine.table(ScrollShaft)
    contacts = contacts_of(frame, machine.table(ShellStructure), 0.08)
    inner = inner_set(frame, free_scroll_shaft(shaft, SHAFT_ELEMENT_M), contacts)
    number, height = len(contacts.part), frame.wraps_height_m
    gaps, bearings = inner.gaps[:number], inner.gaps[number:]
    held = contacts.stiffness[:, None] * gaps
    lossy = [
        part.stiffness * (1.0 + 1j * part.loss_factor_ratio) for part in (inner.bodies, inner.shaft)
    ]
    load = np.zeros((len(PARTS), 6, 2))
    for axis, moment, sign in ((0, 4, 1.0), (1, 3, -1.0)):
        load[PARTS.index(FIXED_SCROLL), [axis, moment], axis] = 1.0, sign * height
    load[PARTS.index(ORBITING_SCROLL)] = -load[PARTS.index(FIXED_SCROLL)]
    pair = inner.loads @ load.reshape(-1, 2)
    steady = block_diag(*lossy) + gaps.T @ held + stiffness * pair @ pair.T
    result = np.empty((2, omega.size), dtype=complex)
    for line, (turning, film) in enumerate(zip(omega, inner.flexibility(omega).T, strict=True)):
        dynamic = steady - turning**2 * inner.mass + bearings.T @ (bearings / film[:, None])
        moved = np.linalg.solve(dynamic, pair)
        result[0, line] = 0.5 * np.trace(pair.T @ moved)
        result[1, line] = contacts.rigid[:, 0] @ (held @ moved[:, 0])
    return result


def check(steps: int) -> float:
    """Largest difference of the motion of a small model from its Floquet solution, relative.

    Two masses one behind the other, 500 and 710 Hz, viscous; a tangential load of orders 3 to 14.
    """
    speed, stiffness = 304.0, 6e6
    mass = np.diag([1.25, 3.0])
    springs = np.array([[2e7, -2e7], [-2e7, 5.2e7]])
    viscous = springs * 0.03 / 3600.0
    order = np.arange(1, 31)
    load = np.where((order >= 3) & (order <= 14), np.exp(1j * order**2) / order, 0.0)
    omega = speed * np.arange(order.size + 2)
    flexibility = np.array(
        [np.linalg.inv(springs + 1j * w * viscous - w**2 * mass)[0, 0] for w in omega]
    )
    forward, backward = 0.5j * load, -0.5j * load
    contact = contact_force(flexibility, stiffness, forward, backward)
    ahead = flexibility[2:] * (forward - 0.5 * contact)
    behind = flexibility[:-2] * (backward - 0.5 * contact)

    angle = 2.0 * np.pi * np.arange(2 * steps + 1) / (2 * steps)
    turning = np.exp(1j * np.outer(angle, order))
    exact = (turning * np.exp(1j * angle)[:, None]) @ ahead
    exact = exact + np.conj((turning * np.exp(-1j * angle)[:, None]) @ behind)
    force = 1j * np.exp(1j * angle) * (turning @ load).real
    still, both = np.zeros((4, 4)), [np.kron(m, np.eye(2)) for m in (mass, springs, viscous)]
    inverse = np.linalg.inv(both[0])

    def slope(at: int, state: np.ndarray) -> np.ndarray:
        along = np.array([np.cos(angle[at]), np.sin(angle[at])])
        turned = still.copy()
        turned[:2, :2] = stiffness * np.outer(along, along)
        push = np.zeros((4, state.shape[1]))
        push[:2, -1] = force[at].real, force[at].imag
        pull = (both[1] + turned) @ state[:4] + both[2] @ state[4:]
        return np.concatenate([state[4:], inverse @ (push - pull)]) / speed

    def turn(state: np.ndarray) -> np.ndarray:
        h, every = 2.0 * np.pi / steps, [state]
        for step in range(0, 2 * steps, 2):
            one = slope(step, state)
            two = slope(step + 1, state + 0.5 * h * one)
            three = slope(step + 1, state + 0.5 * h * two)
            four = slope(step + 2, state + h * three)
            state = state + h / 6.0 * (one + 2.0 * two + 2.0 * three + four)
            every.append(state)
        return np.array(every)

    # Columns: eight unit states without load, and rest with it.
    unit = np.hstack([np.eye(8), np.zeros((8, 1))])
    ends = turn(unit)[-1]
    free = ends[:, :8]
    first = np.linalg.solve(np.eye(8) - free, ends[:, 8])
    found = turn(first[:, None])[:, :2, 0]
    difference = found[:, 0] + 1j * found[:, 1] - exact[::2]
    return float(np.abs(difference).max() / np.abs(exact).max())


if __name__ == "__main__":
    main()
