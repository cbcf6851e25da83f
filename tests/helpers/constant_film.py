"""The key integrator with the contacts of an earlier model, as a test double.

A film force c V acts beside K d^1.5 (1 + β d'/V₀), V₀ the speed at which the contact began but at
least 10 mm/s, and β = ¾ (1 - e²) (Lankarani & Nikravesh 1990).
"""

from functools import cache
from types import FunctionType

import numba

from vibroacoustics.sources.oldham_keys import integration, rattle
from vibroacoustics.sources.oldham_keys.equations import (
    FRICTION,
    KEYS,
    NORMAL,
    RATE,
    SHIFT,
    slide_directions,
)

COMPILED = {"nogil": True, "error_model": "numpy"}
LEAST_APPROACH, HYSTERESIS = 0.01, 0.75 * (1.0 - 0.7**2)
STEPPED = ("deflect", "integrate")
"""Functions that call the replaced ones, from the inside outwards."""
ORIGINALS = {name: getattr(integration, name).py_func for name in STEPPED}


def renamed(name: str) -> FunctionType:
    """A copy under another name: compiled code of one name is not linked to cached code of it."""
    copied = FunctionType(ORIGINALS[name].__code__, vars(integration))
    copied.__name__ = copied.__qualname__ = f"constant_film_{name}"
    return copied


@cache
def doubles(film_ns_per_m: float) -> dict[str, object]:
    """Functions by name; numba looks their names up in the module when it compiles them."""

    @numba.njit(**COMPILED)
    def next_deflection(approach, before, after, step, face):
        """The state of a face is the speed at which its contact began."""
        if after >= 0.0:
            return 0.0
        return approach if approach > 0.0 else max((before - after) / step, LEAST_APPROACH)

    @numba.njit(**COMPILED)
    def push(approach, gap, speed, face):
        if approach <= 0.0:
            return 0.0
        return max(face.stiffness * (-gap) ** 1.5 * (1.0 + HYSTERESIS * speed / approach), 0.0)

    @numba.njit(**COMPILED)
    def key_forces(drive, rate, approaches, c, keys):
        """A film resists both ways, as a key always approaches one face; only contacts rub."""
        scroll, housing = slide_directions(drive, rate, c)
        for key in range(KEYS):
            shift, speed = keys[SHIFT, key], keys[RATE, key]
            ahead = push(approaches[0, key], c.clearance - shift, speed, c.face)
            behind = push(approaches[1, key], c.clearance + shift, -speed, c.face)
            keys[NORMAL, key] = behind - ahead - film_ns_per_m * speed
            keys[FRICTION, key] = (ahead + behind) * (scroll if key < 2 else housing)

    stepped = {name: numba.njit(**COMPILED)(renamed(name)) for name in STEPPED}
    return {"next_deflection": next_deflection, "key_forces": key_forces, **stepped}


def use_constant_film(monkeypatch, film_ns_per_m: float) -> None:
    """Replace film and face in series by the earlier model's contact with a film beside it.

    Parameters
    ----------
    monkeypatch : of the test
    film_ns_per_m : c, on the face that a key approaches
    """
    for name, double in doubles(film_ns_per_m).items():
        monkeypatch.setattr(integration, name, double)
    monkeypatch.setattr(rattle, "integrate", integration.integrate)


def crown_for(stiffness: float, modulus_pa: float) -> float:
    """Radius of the crown whose Hertz stiffness is given, m."""
    return float((0.75 * stiffness / modulus_pa) ** 2)
