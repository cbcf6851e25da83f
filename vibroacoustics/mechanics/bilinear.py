"""A mass on a spring that is stiff one way and soft the other, shaken at its foot.

S. W. Shaw, P. J. Holmes, A periodically forced piecewise linear oscillator, J. Sound Vib. 90
(1983) 129. Between the crossings of zero the motion is linear and known in closed form.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from math import pi
from typing import Final

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from ..base.arrays import Array
from ..base.errors import SolverError

STEPS: Final = 256
"""Steps in a revolution; two crossings of zero within one would be missed."""
SETTLING_REVOLUTIONS: Final = 60
NEWTON_STEPS: Final = 30
TOLERANCE: Final = 1e-11


@dataclass(frozen=True)
class Bilinear:
    """w'' + 2 δ w' + κ(w) w = cos θ over the crank angle θ; w is the stretch over the stroke.

    Attributes
    ----------
    pulled : κ for w > 0, stiffness over m ω²
    pushed : κ for w < 0
    damping : δ, above zero, damping over 2 m ω
    """

    pulled: float
    pushed: float
    damping: float

    @property
    def natural_ratio(self) -> float:
        """Natural frequency without damping over the shaft frequency: half a swing on each."""
        return 2.0 / float(self.pulled**-0.5 + self.pushed**-0.5)

    def _system(self, stiff: bool) -> Array:
        """State matrix of a side."""
        stiffness = self.pulled if stiff else self.pushed
        return np.array([[0.0, 1.0], [-stiffness, -2.0 * self.damping]])

    def _particular(self, stiff: bool, angle: float) -> Array:
        """Steady motion of a side alone."""
        stiffness = self.pulled if stiff else self.pushed
        turned = np.exp(1j * angle) / (stiffness - 1.0 + 2j * self.damping)
        return np.array([turned.real, -turned.imag])

    def steps(self, start: Array, steps: int, count: int) -> Iterator[tuple[Array, Array]]:
        """State after each of the equal steps from crank angle zero, and its derivative by the
        state before.

        Parameters
        ----------
        start : w and w', shape (2,)
        steps : in a revolution
        count : number of steps
        """
        length = 2.0 * pi / steps
        flows = {stiff: expm(self._system(stiff) * length) for stiff in (True, False)}
        state = start
        for number in range(count):
            angle, stiff = number * length, _is_stiff(state)
            apart = state - self._particular(stiff, angle)
            after = flows[stiff] @ apart + self._particular(stiff, angle + length)
            flow = flows[stiff]
            if after[0] * (1.0 if stiff else -1.0) < 0.0:
                after, flow = self._across(angle, length, apart, stiff)
            state = after
            yield state, flow

    def _across(
        self, angle: float, length: float, apart: Array, stiff: bool
    ) -> tuple[Array, Array]:
        """A step that changes sides: state after it and derivative by the state before."""

        def state_after(time: float) -> Array:
            homogeneous = expm(self._system(stiff) * time) @ apart
            return np.asarray(homogeneous + self._particular(stiff, angle + time))

        begun = 1e-9 * length
        crossing = 0.0  # of a step that starts at zero
        if state_after(begun)[0] * state_after(length)[0] < 0.0:
            crossing = float(brentq(lambda time: state_after(time)[0], begun, length, xtol=1e-15))
        first = expm(self._system(stiff) * crossing)
        second = expm(self._system(not stiff) * (length - crossing))
        other = state_after(crossing) - self._particular(not stiff, angle + crossing)
        after = second @ other + self._particular(not stiff, angle + length)
        return np.asarray(after), np.asarray(second @ first)


def _is_stiff(state: Array) -> bool:
    return bool(state[0] > 0.0 or (state[0] == 0.0 and state[1] > 0.0))


@cache
def settled_start(oscillator: Bilinear) -> tuple[float, float]:
    """State at crank angle zero of the stable motion that repeats every revolution.

    Raises
    ------
    SolverError
        There is none: it repeats after several revolutions or not at all.
    """
    state, _ = _after(oscillator, np.zeros(2), SETTLING_REVOLUTIONS)
    for _ in range(NEWTON_STEPS):
        after, tangent = _after(oscillator, state, 1)
        change = np.linalg.solve(np.eye(2) - tangent, after - state)
        state = state + change
        if np.max(np.abs(change)) < TOLERANCE * (1.0 + np.max(np.abs(state))):
            if np.max(np.abs(np.linalg.eigvals(tangent))) < 1.0:
                return float(state[0]), float(state[1])
            break
    raise SolverError(
        "one-way springs: no stable motion repeats every revolution; they resonate at "
        f"{oscillator.natural_ratio:.3g} of the shaft frequency"
    )


def _after(oscillator: Bilinear, start: Array, revolutions: int) -> tuple[Array, Array]:
    """State after some revolutions, and its derivative by the state before."""
    state, tangent = start, np.eye(2)
    for following, flow in oscillator.steps(start, STEPS, revolutions * STEPS):
        state, tangent = following, flow @ tangent
    return state, tangent


def stretch(oscillator: Bilinear, samples: int) -> tuple[Array, Array]:
    """w and w' of the settled motion at uniform crank angles from zero, shape (samples,)."""
    fold = -(-STEPS // samples)
    start = np.array(settled_start(oscillator))
    states = [
        start,
        *(state for state, _ in oscillator.steps(start, fold * samples, fold * samples)),
    ]
    shown = np.array(states[:-1:fold])
    return shown[:, 0], shown[:, 1]
