"""Spellings of units in heads of files: `m/s^2`, `m s-2` and `m/s/s` are `m/s²`."""

from typing import Final

from .units import UNITS, Unit

_SIGNS: Final = str.maketrans(
    {"²": "2", "³": "3", "⁻": "-", "¹": "1", "μ": "µ", "·": " ", "*": " ", "^": None}
)
"""Signs that files write in several ways; `μ` is the Greek letter, `µ` the micro sign."""

_OTHERS: Final = {
    "m/s2": ("m s-2", "m/s/s", "m/(s2)"),
    "mm/s2": ("mm s-2",),
    "m/s": ("m s-1",),
    "mm/s": ("mm s-1",),
    "rad/s": ("rad s-1",),
    "m/(N s)": ("m/s/N", "(m/s)/N", "m/Ns", "m/(Ns)"),
    "mm/(N s)": ("mm/s/N", "(mm/s)/N", "mm/Ns", "mm/(Ns)"),
    "µPa": ("uPa",),
    "mbar": ("hPa",),
    "µbar": ("ubar",),
    "µm": ("um",),
    "N m": ("Nm",),
    "rpm": ("RPM", "1/min", "r/min", "min-1", "U/min", "tr/min", "rev/min"),
    "rev/s": ("r/s", "rps", "tr/s"),
    "Hz": ("hz", "HZ"),
    "g": ("G", "gn", "g_n"),
    "in/s": ("ips", "in s-1", "inch/s"),
    "mil": ("mils", "thou"),
    "psi": ("psig", "lbf/in2", "lb/in2"),
    "µm/s": ("um/s", "µm s-1"),
    "µV": ("uV",),
    "°": ("deg", "degree", "degrees"),
    "1": ("-",),
    "Pa": ("Pascal", "Pascals", "pascal", "pascals"),
    "N": ("Newton", "Newtons", "newton", "newtons"),
    "V": ("Volt", "Volts", "volt", "volts"),
    "A": ("Ampere", "Amperes", "Amps", "ampere", "amperes", "amps"),
    "dB": ("dB re 20 µPa", "dB re 20µPa"),
}
_SPELLINGS: Final = {other: plain for plain, others in _OTHERS.items() for other in others}


def plain_unit(text: str) -> str:
    """Return the spelling that all spellings of a unit share, `m/s2` for `m s⁻²`."""
    plain = " ".join(text.replace("**", "^").translate(_SIGNS).split())
    return _SPELLINGS.get(plain, plain)


def find_unit(text: str) -> Unit | None:
    """Find the unit of a symbol in any spelling; None where no unit has it.

    Parameters
    ----------
    text : symbol, not a suffix: `MPa` is a unit, `mpa` and `mPa` are none

    Examples
    --------
    >>> find_unit("Nm").suffix
    'n_m'
    """
    plain = plain_unit(text)
    return next((unit for unit in UNITS.values() if plain_unit(unit.symbol) == plain), None)


def symbols(si_suffix: str) -> str:
    """List the symbols of all units of one quantity, for a message."""
    return " or ".join(unit.symbol or "1" for unit in UNITS.values() if unit.si_suffix == si_suffix)
