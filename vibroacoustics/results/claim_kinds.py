"""Kinds of claims that headlines of commands state, with the conditions of each."""

from typing import Final

from .conditional import ClaimKind, Condition

_BANDS_TO_10_KHZ: Final = ("bands", "bands to 10 kHz")
_EVERY_POSITION: Final = "background at each microphone"

GRADE: Final = ClaimKind(
    "grade",
    ("sound-power",),
    (
        Condition("background", "background", "no value"),
        Condition("room", "K2", "no value"),
        Condition("microphones", "10 or 20 microphones (hemisphere), 9 (box)", "no value"),
        Condition("background positions", _EVERY_POSITION, "no value"),
        Condition("sound", "sound at every microphone", "no value"),
        Condition(*_BANDS_TO_10_KHZ, "no value"),
        Condition("margin", "6 dB (grade 2), 3 dB (grade 3) over the background", "lower value"),
        Condition("K2A", "at most 4 dB (grade 2), 7 dB (grade 3)", "lower value"),
    ),
    "ISO 3744, ISO 3746",
)
POWER_LEVEL: Final = ClaimKind(
    "sound power level",
    ("sound-power",),
    (
        Condition("background", "background", "at most", "K1 is 0"),
        Condition("room", "K2", "at most", "K2 is 0"),
        Condition("margin", "6 dB over the background", "at most", "{finding} over the background"),
        Condition("sound", "sound at every microphone", "at least", "no {needed}"),
        Condition(*_BANDS_TO_10_KHZ, "at least", "bands above {finding} are missing"),
    ),
    "ISO 3744",
)

_STEADY: Final = Condition(
    "steady level", "range of 4 dB", "remark", "its level varies by {finding}"
)
_LOUD: Final = Condition(
    "third octaves below 300 Hz", "third octaves of 120 dB at most", "no value"
)
_TO_12_KHZ: Final = Condition(
    "bands", "bands to 12.5 kHz", "at least", "bands above {finding} are missing"
)
LOUDNESS: Final = ClaimKind("loudness", ("tones",), (_TO_12_KHZ, _LOUD, _STEADY), "ISO 532-1")
SHARPNESS: Final = ClaimKind(
    "sharpness",
    ("tones",),
    (
        _TO_12_KHZ,
        Condition("sound below the missing bands", "bands to 12.5 kHz", "no value"),
        Condition("audible sound", "0.1 sone", "no value"),
        _LOUD,
        _STEADY,
    ),
    "DIN 45692",
)
ADJUSTMENT: Final = ClaimKind(
    "tonal adjustment",
    ("tones",),
    (
        Condition("range", "tones to 11.22 kHz", "at least", "tones above {finding} are not rated"),
        Condition("spectra", "12 spectra of 3 s", "remark", "{finding} of {needed}"),
        Condition("steady lines", "lines of constant frequency", "remark", "its lines {finding}"),
    ),
    "ISO/PAS 20065, ISO 1996-2",
)

_SAMPLES: Final = ("samples", "weighted samples")
INTERVAL: Final = ClaimKind(
    "80 % interval",
    ("run", "report", "score"),
    (
        Condition(*_SAMPLES, "no value"),
        Condition(
            "effective samples", "30 effective samples", "remark", "{finding} effective samples"
        ),
    ),
)
CHANGE: Final = ClaimKind(
    "change of the level",
    ("run", "report", "score"),
    (
        Condition("change", "a measurable change in most samples", "lower value"),
        Condition("interval", "an interval beyond the smallest measurable change", "lower value"),
    ),
)
KWAVE: Final = ClaimKind(
    "radiation",
    ("run", "report", "score", "radiation"),
    (Condition("k-Wave", "k-Wave beside the closed form", "remark", "k-Wave did not run"),),
)
RANKING: Final = ClaimKind(
    "ranking",
    ("run", "report", "score"),
    (Condition(*_SAMPLES, "remark", "of nominal values alone"),),
)
UNCERTAINTY: Final = ClaimKind(
    "K_WA", ("datasheet",), (Condition("samples", "samples that differ", "no value"),), "ISO 4871"
)
SHEET_LEVEL: Final = ClaimKind(
    "L_WA",
    ("datasheet",),
    (Condition("published level", "a published level", "remark", "of the modelled sources alone"),),
)
PROMISE: Final = ClaimKind(
    "promise of a design",
    ("sweep", "optimise"),
    (
        Condition("constraints", "a design that meets every constraint", "no value"),
        Condition(*_SAMPLES, "remark", "for nominal values of the machine"),
    ),
)
COHERENCE: Final = ClaimKind(
    "coherence",
    ("orders", "compare"),
    (
        Condition("any speed", "8 blocks at a speed", "no value"),
        Condition("every speed", "8 blocks at each speed", "remark", "at {finding} speeds"),
    ),
)
MEAN_INTERVAL: Final = ClaimKind(
    "95 % interval of the mean",
    ("orders",),
    (Condition("runs", "2 runs, of several machines 2 machines", "no value"),),
)
REPLAYED: Final = ClaimKind(
    "level with the option",
    ("replay",),
    (
        Condition("lines", "a line that can be changed", "no value"),
        Condition(*_SAMPLES, "remark", "no interval: the study has no samples"),
    ),
)
BAND: Final = ClaimKind(
    "90 % band",
    ("predict", "blocked-forces"),
    (Condition("faults", "measurements without accepted faults", "no value"),),
)
TRUNCATION: Final = ClaimKind(
    "choice of the truncation",
    ("blocked-forces",),
    (Condition("responses", "more responses than forces", "no value"),),
)
FUNCTIONS: Final = ClaimKind(
    "verdict",
    ("check-functions",),
    (
        Condition("passivity", "driving points", "remark", "passivity not tested at {finding}"),
        Condition("reciprocity", "pairs", "remark", "reciprocity not tested at {finding}"),
    ),
)
HAMMERED: Final = ClaimKind(
    "frequency responses",
    ("hammer",),
    (
        Condition("hits", "2 hits of each point", "remark", "no coherence of {finding}"),
        Condition("records", "no fault of the records", "remark", "faults: {finding}"),
    ),
)
BALANCE_GRADE: Final = ClaimKind(
    "balance quality grade",
    ("balance",),
    (
        Condition("mass", "mass of the rotor", "no value"),
        Condition("scatter", "scatter of the readings", "no value"),
    ),
    "ISO 21940-11",
)
PROBABILITY: Final = ClaimKind(
    "probability",
    ("permit",),
    (Condition("deviation", "a deviation above 0 dB", "no value"),),
)
LEAST_DISTANCE: Final = ClaimKind(
    "least distance",
    ("permit",),
    (Condition("distance", "a limit that is met within 2 km", "no value"),),
)

KINDS: Final = (
    GRADE, POWER_LEVEL, LOUDNESS, SHARPNESS, ADJUSTMENT, INTERVAL, CHANGE, KWAVE, RANKING,
    UNCERTAINTY, SHEET_LEVEL, PROMISE, COHERENCE, MEAN_INTERVAL, REPLAYED, BAND, TRUNCATION,
    FUNCTIONS, HAMMERED, BALANCE_GRADE, PROBABILITY, LEAST_DISTANCE,
)  # fmt: skip
"""All kinds."""
UNCONDITIONAL: Final = {
    "check": "Costs; each line says whether it is measured.",
    "curves": "Names of the curves.",
    "new": "Names of the files.",
    "listen": "Names of the sounds; the gain is in the name.",
    "impulse-responses": "Largest value of each response.",
    "track": "Largest amplitude of each order; refused where the speed is not known.",
    "map": "Names of the files; speeds to avoid are listed for run-ups alone.",
    "export": "Name of the file.",
    "cache": "Stored results.",
    "doctor": "Versions and memory.",
    "schema": "Schemas.",
}
"""Content of the headlines of commands without a conditional claim."""
