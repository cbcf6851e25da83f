"""Sentences of the loudest channel and order, with which the page of a recording begins."""

from ..base import rounding
from ..base.decibel import amplitude_of_level
from ..results.over_speed.loudest_channel import LoudestChannel


def loudest_sentences(loudest: LoudestChannel) -> tuple[str, ...]:
    """Return the answer: loudest channel, loudest order, and how far the channels differ."""
    curves = loudest.curves
    words = []
    level, quietest = (
        None if value is None else rounding.fixed(value)
        for value in (loudest.overall_db, loudest.quietest_db)
    )
    among = " is the loudest channel" if loudest.channels > 1 else ""
    if level is not None:
        words.append(f"{curves.channel}{among}: {level} dB(A) at {loudest.overall_rpm:.0f} rpm.")
    owner = "Its loudest order" if words else f"{curves.channel}: the loudest order"
    hertz = loudest.order * loudest.order_rpm / 60.0
    where = f"at {loudest.order_rpm:.0f} rpm ({hertz:.4g} Hz)"
    words.append(f"{owner} is {loudest.order:.4g}×: {_order_level(loudest)} {where}.")
    if level == quietest and loudest.channels > 1 and level is not None:
        words.append(f"All {loudest.channels} channels of sound pressure have this level.")
    elif level is not None and loudest.channels > 1:
        words.append(
            f"The greatest levels of the {loudest.channels} channels of sound pressure are "
            f"{quietest} to {level} dB(A)."
        )
    return tuple(words)


def _order_level(loudest: LoudestChannel) -> str:
    unit = loudest.curves.unit
    if unit == "Pa":
        return f"{rounding.fixed(loudest.order_db)} dB(A)"
    rms = float(amplitude_of_level(loudest.order_db))
    return f"{rounding.significant(rms, 3)} {unit} RMS"
