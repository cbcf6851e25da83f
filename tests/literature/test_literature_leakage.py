"""Pockets that leak while one opens: masses of all of them by a stiff integration."""

import numpy as np
import pytest
from documents import SECOND
from evidence import claim
from scipy.integrate import solve_ivp
from scroll_openings import GAS, OPENING, SPEED_RPM, WRAPS, gas_at
from test_literature_opening import Masses

from vibroacoustics.sources.scroll_gas.opening import steady_opening
from vibroacoustics.sources.scroll_gas.parameters import ScrollLeakage, pocket_volume
from vibroacoustics.sources.scroll_gas.suction import pocket_pressure

HALF, TURN, CLOSES = np.pi, 2.0 * np.pi, 4.0 / 3.0 * np.pi
LEAKAGE = ScrollLeakage(tip_gap_m=8e-6, flank_gap_m=12e-6, flow_ratio=0.6)


class LeakingMasses(Masses):
    """Two closed pairs, the younger of which closes after 240°, outside the opened gas."""

    def __init__(self, gas, opening, opened):
        super().__init__(gas, opening)
        self.volume = 2.0 * WRAPS.orbit_radius_m * WRAPS.base_radius_m * WRAPS.height_m * TURN
        last = opened.trapped.mass_ratio[-1]
        opens = np.asarray(WRAPS.opening_angle_rad)
        opens_at = float(opened.pair_pa[0])
        mass = 2.0 * float(pocket_volume(WRAPS, opens)) * self.density(opens_at)
        self.closed_mass = mass / last
        leak = opened.trapped.leak_kg_per_s
        outwards = np.interp(opens + np.linspace(0, TURN, 4097), opened.trapped.contact_angle, leak)
        self.mean_flow = mass * self.omega / TURN - outwards[:-1].mean()

    def closed(self, mass, since_closing):
        """Pressure and density of a pair, p V^n at its mass; of suction before it closes."""
        closing = 11.0 * HALF / 2.0 - HALF
        density = mass / (self.volume * (closing - since_closing))
        suction = self.closed_mass / (self.volume * closing)
        if since_closing < 0.0:
            return self.gas.suction_pressure_pa, suction
        ratio = density / suction
        return self.gas.suction_pressure_pa * ratio**self.gas.polytropic_index, density

    def leak(self, inside, outside, contact):
        """Nozzle of Saint-Venant and Wantzel as it is printed, times its gap."""
        sign, (high, density), (low, _) = (
            (1.0, inside, outside) if inside[0] > outside[0] else (-1.0, outside, inside)
        )
        k = self.kappa
        r = max(low / high, (2.0 / (k + 1.0)) ** (k / (k - 1.0)))
        flux = 2.0 * high * density * k / (k - 1.0) * (r ** (2.0 / k) - r ** ((k + 1.0) / k))
        tips = TURN * WRAPS.base_radius_m * contact * LEAKAGE.tip_gap_m
        flanks = 2.0 * WRAPS.height_m * LEAKAGE.flank_gap_m
        return sign * LEAKAGE.flow_ratio * (tips + flanks) * np.sqrt(max(flux, 0.0))

    def rate(self, angle, state, joined):
        opened = super().rate(angle, state[2:], joined)
        volumes = self.volumes(angle, joined)
        of_plenum = self.c.mean_flow - self.mean_flow  # the parent takes that of a tight pair
        opened[2] += of_plenum / self.omega
        density = state[3] / volumes[1] if joined else state[2] / volumes[0]
        inner = self.pressure(density), density
        older = self.closed(state[0], angle + 2.0 / 3.0 * np.pi)
        younger = self.closed(state[1], angle - CLOSES)
        outer_contact = self.inner + TURN - angle
        first = self.leak(inner, older, outer_contact)
        second = self.leak(older, younger, outer_contact + TURN)
        third = 0.0
        if angle >= CLOSES:
            third = self.leak(younger, self.closed(0.0, -1.0), outer_contact + 2.0 * TURN)
        opened[1 if joined else 0] -= first / self.omega
        younger_gains = second - third if angle >= CLOSES else 0.0
        return np.array([*(np.array([first - second, younger_gains]) / self.omega), *opened])

    def over(self, start, joined, angles):
        solved = solve_ivp(
            self.rate, (angles[0], angles[-1]), start, "Radau", angles, args=(joined,), rtol=1e-6,
            atol=[1e-12, 1e-12, 1e-12, 1e-12, 1e-10, 1e-9, 1e-9], max_step=0.05,
        )  # fmt: skip
        assert solved.success
        return solved.y


@pytest.mark.parametrize(
    "point", [pytest.param("ari"), pytest.param("thesis", marks=pytest.mark.long)]
)
def test_a_stiff_integration_of_all_masses_agrees(point):
    """Over a turn from the state at an opening: pressures of all pockets within 0.1 %."""
    gas = gas_at(point)
    ours = steady_opening(WRAPS, gas, OPENING, SPEED_RPM, leakage=LEAKAGE)
    masses = LeakingMasses(gas, OPENING, ours)
    opens = WRAPS.opening_angle_rad
    ratio = np.interp(opens - TURN, ours.trapped.since_closing, ours.trapped.mass_ratio)
    began = np.array([ours.pair_pa[0], ours.chamber_pa[0], ours.plenum_pa[0]])
    opened = np.array(masses.volumes(0.0, False)) * masses.density(began)
    closed = masses.closed_mass * np.array([ratio, 1.0])
    state = np.array([*closed, *opened, 0.0, ours.port_flow_kg_per_s[0]])
    largest = 0.0
    for first, last in ((0.0, HALF), (HALF, CLOSES), (CLOSES, TURN)):
        joined, angles = first >= HALF, np.linspace(first, last, 91)
        history = masses.over(state, joined, angles)
        for n, angle in enumerate(angles[:-1] + 1e-9):
            volumes = masses.volumes(angle, joined)
            obtained = [
                masses.closed(history[0, n], angle + 2.0 / 3.0 * np.pi)[0],
                masses.closed(history[1, n], angle - CLOSES)[0],
                masses.pressure(history[3, n] / volumes[1]),
            ]
            since = np.array([angle + opens - TURN, angle + opens - 2.0 * TURN])
            expected = [
                *pocket_pressure(WRAPS, gas, since, ours),
                np.interp(angle, ours.since_opening, ours.chamber_pa),
            ]
            off = np.abs(np.array(obtained) / np.array(expected) - 1.0)
            largest = max(largest, float(off.max()))
        state = history[:, -1].copy()
        if last == HALF:
            state[3] += state[2]
            state[2] = state[5] = 0.0
    print(f"{point}: largest deviation of a pressure {largest:.1e}")
    claim(
        f"Pressures of leaking pockets by a stiff integration, {point}", kind="second code",
        source=SECOND("Radau of all masses, test_literature_leakage"), computed=largest,
        reference=0.0, tolerance=1e-3, unit="1", topics=("leakage",),
    )  # fmt: skip
    # What is left in the older pair is what the next turn begins with.
    volume = 2.0 * float(pocket_volume(WRAPS, np.asarray(opens)))
    assert masses.pressure(state[0] / volume) == pytest.approx(ours.pair_pa[0], rel=1e-4)
    assert state[1] / masses.closed_mass == pytest.approx(ratio, rel=1e-4)


def test_the_gaps_of_the_machine_lose_three_hundredths():
    """7 µm at 0.3 of a nozzle's flow, at ARI's point and 2900 rpm."""
    gaps = ScrollLeakage(tip_gap_m=7e-6, flank_gap_m=7e-6, flow_ratio=0.3)
    leaking = steady_opening(WRAPS, GAS, OPENING, SPEED_RPM, leakage=gaps)
    tight = steady_opening(WRAPS, GAS, OPENING, SPEED_RPM)
    kept = leaking.port_flow_kg_per_s[1:].mean() / tight.port_flow_kg_per_s[1:].mean()
    assert 1.0 - kept == pytest.approx(0.03, abs=0.005)
