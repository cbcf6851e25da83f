"""A data sheet as page, CSV and JSON."""

from collections.abc import Iterator

from ...base import rounding
from ..blocks import Bullets, Pictures, Text
from ..html import html
from ..page import Page, Part
from ..tables import Table, to_csv
from .figure import sheet_picture
from .model import DataSheet, SoundPower, Vibration

Row = tuple[str, str, str, str | float, str]


def data_sheet_json(sheet: DataSheet) -> bytes:
    """As `data/schemas/data_sheet.json` has it."""
    return sheet.model_dump_json(indent=1).encode() + b"\n"


def data_sheet_csv(sheet: DataSheet) -> bytes:
    """A value a row; the value of a band that has none is empty."""
    return to_csv(("part", "item", "quantity", "value", "unit"), _rows(sheet))


def data_sheet_html(sheet: DataSheet) -> bytes:
    """The page: one or two sheets of A4."""
    power = sheet.sound_power
    parts = (
        Part("level", "Sound power", (Text(headline(sheet), "headline"), *_words(power))),
        Part("bands", "Third octaves", (Pictures((sheet_picture(power),)), _bands(power))),
        Part("tones", "Tones", _tones(sheet)),
        Part(
            "vibration",
            "Vibration",
            (_vibration(sheet), Text(_sentence(sheet.vibration_words), "note")),
        ),
        Part("conditions", "Operating point and mounting", (_facts(sheet),)),
        Part("limits", "What it leaves out", (Bullets(sheet.leaves_out),)),
    )
    about = (
        f"Option {sheet.option} at {sheet.speed_rpm:g} rpm: {sheet.statement}. {sheet.title}. "
        f"vibroacoustics {sheet.software_version}, values {sheet.parameters_sha256[:12]}."
    )
    page = Page(f"Data sheet (predicted): {sheet.machine}", sheet.machine, sheet.created_utc, parts)
    return html(page._replace(about=about))


def headline(sheet: DataSheet) -> str:
    """L_WA and K in a sentence."""
    power = sheet.sound_power
    alone = ", of what is modelled alone" if power.rest == "none" else ""
    if power.declared is not None:
        level, uncertainty = power.declared
        return (
            f"L_WA = {level} dB, K_WA = {uncertainty} dB re 1 pW (dual number, as in ISO 4871): "
            f"{sheet.statement}{alone}."
        )
    level_dba = float("nan") if power.level_dba is None else power.level_dba
    level_words = f"L_WA = {rounding.fixed(level_dba)} dB re 1 pW, K_WA not known"
    return f"{level_words}: {sheet.statement}{alone}."


def _words(power: SoundPower) -> tuple[Text, ...]:
    modelled = "–" if power.modelled_dba is None else rounding.fixed(power.modelled_dba)
    lowest, highest = (rounding.significant(one) for one in power.model_range_hz)
    return (
        Text(f"Of the model alone L_WA = {modelled} dB; beside it: {power.rest_words}."),
        Text(_sentence(power.uncertainty_words), "note"),
        Text(
            f"L_W is the {power.determined}. Bands of the model reach from {lowest} to {highest} "
            "Hz; outside, and where nothing sounds, they are empty.",
            "note",
        ),
    )


def _bands(power: SoundPower) -> Table:
    rows = tuple(
        (f"{band.band_hz:g}", *map(_shown, (band.modelled_db, band.rest_db, band.total_db)))
        for band in power.bands
    )
    head = ("Band, Hz", "modelled", power.rest, "total")
    return Table("Sound power level in third octaves, dB re 1 pW, no weighting", head, rows)


def _tones(sheet: DataSheet) -> tuple[Text | Table, ...]:
    judged = "ECMA-418-1, by tone-to-noise or prominence ratio, at the microphones of the sheet"
    count = sheet.tones_not_judged
    others = (
        f"{count} audible tone{'' if count == 1 else 's'} without noise in the critical band "
        f"{'is' if count == 1 else 'are'} not judged."
    )
    not_judged = (Text(others),) if count else ()
    if not sheet.tones:
        which = "No tone is prominent" if not count else "No other tone is prominent"
        return *not_judged, Text(f"{which} ({judged}).")
    rows = tuple(
        (
            one.name,
            rounding.significant(one.frequency_hz, 4),
            one.microphone,
            rounding.fixed(one.level_db),
            rounding.fixed(one.tone_to_noise_db),
            _shown(one.prominence_db),
        )
        for one in sheet.tones
    )
    head = ("Tone", "Hz", "Microphone", "Lp, dB", "tone to noise, dB", "prominence, dB")
    return *not_judged, Table(f"Prominent tones ({judged})", head, rows, frozenset({0, 2}))


def _vibration(sheet: DataSheet) -> Table:
    """A row a point, a column a quantity and direction."""
    of_point: dict[str, list[Vibration]] = {}
    for one in sheet.vibration:
        of_point.setdefault(one.point, []).append(one)
    rows = tuple(
        (
            point,
            *(rounding.significant(1e6 * one.displacement_peak_to_peak_m) for one in motions),
            *(rounding.significant(1e3 * one.velocity_rms_m_per_s) for one in motions),
            *(rounding.significant(one.acceleration_rms_m_per_s2) for one in motions),
        )
        for point, motions in of_point.items()
    )
    directions = [one.direction for one in next(iter(of_point.values()))]
    names = ("s p-p, µm", "v rms, mm/s", "a rms, m/s²")
    head = ("Point", *(f"{name}, {axis}" for name in names for axis in directions))
    return Table("Displacement s, velocity v and acceleration a along x, y, z", head, rows)


def _facts(sheet: DataSheet) -> Table:
    rows = tuple(
        (one.name, f"{_value(one.value)} {one.unit}".strip(), kind)
        for kind, facts in (("operation", sheet.operating), ("mounting", sheet.mounting))
        for one in facts
    )
    head = ("", "Value", "")
    return Table("As EN 12102-1 asks", head, rows, frozenset({0, 1, 2}))


def _value(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:g}"


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def _shown(level: float | None) -> str:
    return "" if level is None else rounding.fixed(level)


def _rows(sheet: DataSheet) -> Iterator[Row]:
    power = sheet.sound_power
    yield "statement", sheet.statement, "", "", ""
    for part, facts in (("operating", sheet.operating), ("mounting", sheet.mounting)):
        for one in facts:
            yield part, one.name, "", one.value, one.unit
    for name in ("level_dba", "modelled_dba", "nominal_dba", "uncertainty_k_db"):
        yield "sound power", "A-weighted", name, _cell(getattr(power, name)), "dB"
    for band in power.bands:
        for name in ("modelled_db", "rest_db", "total_db"):
            yield "sound power", f"{band.band_hz:g} Hz", name, _cell(getattr(band, name)), "dB"
    for tone in sheet.tones:
        for name, unit in (
            ("frequency_hz", "Hz"), ("level_db", "dB"), ("tone_to_noise_db", "dB"),
            ("prominence_db", "dB"),
        ):  # fmt: skip
            item = f"{tone.name} at {tone.microphone}"
            yield "prominent tone", item, name, _cell(getattr(tone, name)), unit
    for point in sheet.vibration:
        item = f"{point.point} {point.direction}"
        yield "vibration", item, "displacement p-p", point.displacement_peak_to_peak_m, "m"
        yield "vibration", item, "velocity rms", point.velocity_rms_m_per_s, "m/s"
        yield "vibration", item, "acceleration rms", point.acceleration_rms_m_per_s2, "m/s²"


def _cell(level: float | None) -> str | float:
    return "" if level is None else level
