"""Analysis of a data sheet: page, table and JSON."""

from collections.abc import Iterator
from typing import Final

from ..base import rounding
from ..base.decibel import NO_TONE_DB
from ..results.conditional import ConditionalClaim
from ..results.data_sheet import BandPower, DataSheet, SoundPower, Tone, Vibration
from ..results.estimates import Estimate
from .analysis import Analysis
from .blocks import Bullets, Part, Pictures, Text
from .conditions import sheet_claims
from .figures.sources import sheet_chart
from .file_names import file_name
from .sections.tones import excess_words
from .tables import Table, cell, columns_of

Row = tuple[str, str, str, str | float, str]
_HEAD: Final = ("part", "item", "quantity", "value", "unit")
_OF_ALL: Final = ("level_dba", "modelled_dba", "nominal_dba", "uncertainty_k_db", "model_spread_db",
                  "measurement_deviation_db", "batch_deviation_db")  # fmt: skip
_OF_BAND: Final = ("modelled_db", "modelled_below_db", "unmodelled_db", "total_db")
_OF_TONE: Final = (
    ("frequency_hz", "Hz"), ("level_db", "dB"), ("excess_db", "dB"),
    ("excess_low_db", "dB"), ("excess_high_db", "dB"), ("probability", "1"),
)  # fmt: skip
_OF_WINDOW: Final = (
    ("rating_level_dba", "dB"), ("rating_level_low_dba", "dB"), ("rating_level_high_dba", "dB"),
    ("adjustment_db", "dB"), ("limit_dba", "dB"), ("limit_probability", "1"),
)  # fmt: skip
_OF_POINT: Final = (
    ("displacement_peak_to_peak_m", "displacement p-p", "m", "s p-p, µm", 1e6),
    ("velocity_rms_m_per_s", "velocity rms", "m/s", "v rms, mm/s", 1e3),
    ("acceleration_rms_m_per_s2", "acceleration rms", "m/s²", "a rms, m/s²", 1.0),
)
"""Field, its quantity and unit in the CSV, its head in the page and what it is multiplied by."""


def analysis_of_data_sheet(sheet: DataSheet) -> Analysis:
    """Return the page of a sheet, one or two sheets of A4, with its table and JSON."""
    power, name = sheet.sound_power, file_name(f"{sheet.option}_{sheet.speed_rpm:g}_rpm")
    vibration = (_vibration(sheet), Text(_sentence(sheet.vibration_words), "note"))
    content = sheet.model_dump_json(indent=1).encode() + b"\n"
    return Analysis(
        f"data_sheet_{name}",
        title=f"Data sheet (predicted): {sheet.machine}",
        kind=sheet.machine,
        created=sheet.created_utc,
        about=f"Option {sheet.option} at {sheet.speed_rpm:g} rpm: {sheet.statement}. "
        f"{sheet.title}. vibroacoustics {sheet.software_version}, values "
        f"{sheet.parameters_sha256[:12]}.",
        parts=(
            Part("level", "Sound power", _words(power)),
            Part("bands", "Third octaves", (Pictures((sheet_chart(power),)), _bands(power))),
            Part("tones", "Tones", (*_tones(sheet), _audibility(sheet), *_windows(sheet))),
            Part("vibration", "Vibration", vibration),
            Part("conditions", "Operating point and mounting", (_facts(sheet),)),
            Part("limits", "Neglected effects", (Bullets(sheet.leaves_out),)),
            Part("not_available", "Not available (ISO 4871)", (Bullets(sheet.not_available),)),
        ),
        summary=tuple(filter(None, (sheet.example, headline(sheet)))),
        tables={f"data_sheet_{name}.csv": columns_of(_HEAD, _rows(sheet))},
        further={f"data_sheet_{name}.json": content},
        claims=_claims(sheet),
        figures=f"data_sheet_{name}_",
    )


def headline(sheet: DataSheet) -> str:
    """Return L_WA and K_WA in a sentence."""
    power = sheet.sound_power
    level, uncertainty = _claims(sheet)
    alone = "".join(f", {check.lacking}" for check in level.missing("remark"))
    whose = "single machine" if power.batch_deviation_db is None else "batch"
    words = f"{level.value} dB re 1 pW, {uncertainty.short}"
    if not uncertainty.is_withdrawn:
        words = (
            f"{level.value} dB, K_WA = {uncertainty.value} re 1 pW "
            f"(dual number, as in ISO 4871; {whose})"
        )
    return f"L_WA = {words}: {sheet.statement}{alone}."


def _claims(sheet: DataSheet) -> tuple[ConditionalClaim, ConditionalClaim]:
    power = sheet.sound_power
    level = str(power.declared[0]) if power.declared else _shown(power.level_dba)
    return sheet_claims(power, level or rounding.NOTHING)


def _words(power: SoundPower) -> tuple[Text, ...]:
    modelled = _shown(power.modelled_dba) or rounding.NOTHING
    lowest, highest = map(rounding.significant, power.model_range_hz)
    return (
        Text(f"Modelled sources alone: L_WA = {modelled} dB. Besides: {power.unmodelled_words}."),
        Text(f"{_sentence(power.uncertainty_words)} Prior: {power.prior}.", "note"),
        Text(
            f"L_W is the {power.determined}. The model covers {lowest} to {highest} Hz. Bands are "
            "medians of the weighted samples where there are samples; parts then do not add up to "
            "the machine.",
            "note",
        ),
    )


def _bands(power: SoundPower) -> Table:
    rows = tuple(
        (f"{band.band_hz:g}", _modelled(band), _shown(band.unmodelled_db), _shown(band.total_db))
        for band in power.bands
    )
    head = ("Band, Hz", "modelled", power.unmodelled_kind, "machine")
    return Table("Sound power level in third octaves, dB re 1 pW, no weighting", head, rows)


def _modelled(band: BandPower) -> str:
    if band.modelled_below_db is not None:
        return f"model: below {rounding.fixed(band.modelled_below_db, 0)}"
    return _shown(band.modelled_db) or "not modelled"


def _tones(sheet: DataSheet) -> tuple[Text | Table, ...]:
    judged = (
        "ECMA-418-1, by tone-to-noise or prominence ratio, at the microphones of the sheet, "
        "in more than half of the weighted samples"
    )
    count = sheet.tones_not_judged
    others = (
        f"{count} audible tone{'' if count == 1 else 's'} without noise in the critical band "
        f"{'is' if count == 1 else 'are'} not judged."
    )
    without_noise = (Text(others),) if count else ()
    if not sheet.tones:
        which = "No tone is prominent" if not count else "No other tone is prominent"
        return *without_noise, Text(f"{which} ({judged}). {_any_tone(sheet)}".rstrip())
    rows = tuple(
        (
            tone.name,
            rounding.significant(tone.frequency_hz, 4),
            tone.microphone,
            rounding.fixed(tone.level_db),
            rounding.fixed(tone.excess_db),
            _interval(tone),
            f"{100.0 * tone.probability:.0f} %",
        )
        for tone in sheet.tones
    )
    head = ("Tone", "Hz", "Microphone", "Lp, dB", "excess, dB", "80 % interval, dB", "probability")
    caption = f"Prominent tones ({judged})"
    table = Table(caption, head, rows, frozenset({0, 2}))
    some = _any_tone(sheet)
    return *without_noise, table, *((Text(some),) if some else ())


def _audibility(sheet: DataSheet) -> Text:
    """Return the audibility of the most audible tone and its adjustment."""
    return Text(
        f"Largest audibility of a tone (ISO/PAS 20065): {rounding.fixed(sheet.audibility_db)} "
        f"dB; adjustment {sheet.tonal_adjustment_db:g} dB (ISO 1996-2)."
    )


def _windows(sheet: DataSheet) -> tuple[Table, ...]:
    """Return the rating levels at the windows of the study."""
    rows = tuple(
        (
            rated.window,
            f"{rounding.fixed(rated.rating_level_dba)} "
            f"({rounding.fixed(rated.rating_level_low_dba)} to "
            f"{rounding.fixed(rated.rating_level_high_dba)})",
            f"{rated.adjustment_db:g}",
            f"{rated.limit_dba:g}",
            f"{100.0 * rated.limit_probability:.0f} %",
        )
        for rated in sheet.windows
    )
    head = ("Window", "L_r, dB(A)", "of it for tones, dB", "limit, dB(A)", "met with probability")
    return (Table("Rating level", head, rows, frozenset({0})),) if rows else ()


def _any_tone(sheet: DataSheet) -> str:
    """Return how often some tone is prominent, where samples differ in it."""
    share = sheet.any_tone_probability
    if share in (0.0, 1.0):
        return ""
    return f"Some tone, not always the same, is prominent in {100.0 * share:.0f} % of the samples."


def _interval(tone: Tone) -> str:
    low = NO_TONE_DB if tone.excess_low_db is None else tone.excess_low_db
    return excess_words(Estimate(low, tone.excess_db, tone.excess_high_db))


def _vibration(sheet: DataSheet) -> Table:
    """Table with a row for each point and a column for each quantity and direction."""
    of_point: dict[str, list[Vibration]] = {}
    for motion in sheet.vibration:
        of_point.setdefault(motion.point, []).append(motion)
    rows = tuple(
        (
            point,
            *(
                rounding.significant(factor * getattr(motion, name))
                for name, _, _, _, factor in _OF_POINT
                for motion in motions
            ),
        )
        for point, motions in of_point.items()
    )
    directions = [motion.direction for motion in next(iter(of_point.values()))]
    head = ("Point", *(f"{each[3]}, {axis}" for each in _OF_POINT for axis in directions))
    return Table("Displacement s, velocity v and acceleration a along x, y, z", head, rows)


def _facts(sheet: DataSheet) -> Table:
    rows = tuple(
        (fact.name, f"{value} {fact.unit}".strip(), kind)
        for kind, facts in (("operation", sheet.operating), ("mounting", sheet.mounting))
        for fact in facts
        for value in [fact.value if isinstance(fact.value, str) else f"{fact.value:g}"]
    )
    head = ("", "Value", "")
    return Table("Conditions (EN 12102-1)", head, rows, frozenset({0, 1, 2}))


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


def _shown(level: float | None) -> str:
    return "" if level is None else rounding.fixed(level)


def _rows(sheet: DataSheet) -> Iterator[Row]:
    power = sheet.sound_power
    yield "statement", sheet.statement, "", "", ""
    for part, facts in (("operating", sheet.operating), ("mounting", sheet.mounting)):
        for fact in facts:
            yield part, fact.name, "", fact.value, fact.unit
    for name in _OF_ALL:
        yield "sound power", "A-weighted", name, cell(getattr(power, name)), "dB"
    yield "sound power", "prior of the unmodelled noise", "", power.prior, ""
    for band in power.bands:
        for name in _OF_BAND:
            yield "sound power", f"{band.band_hz:g} Hz", name, cell(getattr(band, name)), "dB"
    for tone in sheet.tones:
        for name, unit in _OF_TONE:
            item = f"{tone.name} at {tone.microphone}"
            yield "prominent tone", item, name, cell(getattr(tone, name)), unit
    for name in ("audibility_db", "tonal_adjustment_db"):
        yield "tones", "most audible", name, cell(getattr(sheet, name)), "dB"
    for rated in sheet.windows:
        for name, unit in _OF_WINDOW:
            yield "rating", rated.window, name, getattr(rated, name), unit
    for point in sheet.vibration:
        for name, words, unit, _, _ in _OF_POINT:
            item = f"{point.point} {point.direction}"
            yield "vibration", item, words, getattr(point, name), unit
