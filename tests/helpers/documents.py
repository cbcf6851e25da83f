"""Documents that references of claims are from, cited with the passage in them."""

from typing import NamedTuple

from vibroacoustics.results.claims import Document


class Source(NamedTuple):
    """A passage in a document: equation, table, page or section."""

    document: Document
    passage: str


class Cited(Document):
    """A document that a passage makes a source."""

    def __call__(self, passage: str) -> Source:
        """Return the passage in the document."""
        return Source(self, passage)


OURS = "The vibroacoustics authors"
ISO = "International Organization for Standardization"

# --- documents of the machines (docs/sources.md) --------------------------------------------------

THESIS = Cited(
    "thesis", "not in the copy used", "Dynamic analysis of a scroll compressor, master's thesis",
    "about 2007",
)  # fmt: skip
ZHAO = Cited(
    "Zhao", "M. Zhao, S. Yu, C. Li, Y. Yang",
    "Effect of Mechanism Error on Input Torque of Scroll Compressor", "2013",
)  # fmt: skip
ESTUPINAN = Cited(
    "Estupiñan", "E. A. Estupiñan, I. F. Santos",
    "Modelling Hermetic Compressors Using Different Constraint Equations to Accommodate Multibody "
    "Dynamics and Hydrodynamic Lubrication", "2009",
)  # fmt: skip
TSUJI = Cited(
    "Tsuji", "T. Tsuji, T. Oku, N. Ishii and others",
    "Calculated Optimal Mechanical Efficiency of a Large Capacity Reciprocating Compressor, "
    "Purdue paper 2127", "2012",
)  # fmt: skip
DAGILIS = Cited(
    "Dagilis", "V. Dagilis, L. Vaitkus, D. Kirejchick",
    "Slider-link driven compressor (I). Mathematical model", "2006",
)  # fmt: skip

# --- closed forms and other codes -----------------------------------------------------------------

FORM = Cited("closed form", OURS, "Closed forms, derived in the test that is named", "2026")
APART = Cited(
    "computed apart", OURS, "Unpublished computations apart from this code, by the equation cited",
    "2026",
)  # fmt: skip
SECOND = Cited(
    "second method", OURS, "Second methods in tests/oracles and tests/helpers of the repository",
    "2026",
)  # fmt: skip
BUKAC = Cited("Bukac", "H. Bukac", "ICEC at Purdue, paper 1875", "2008")
TAYLOR = Cited(
    "Taylor", "C. F. Taylor", "The Internal-Combustion Engine in Theory and Practice, volume 2",
    "1985",
)  # fmt: skip
VARSI = Cited("Varsi", "G. Varsi", "Pacific Journal of Mathematics 46, 315 to 319", "1973")
ABRAMOWITZ = Cited(
    "Abramowitz", "M. Abramowitz, I. A. Stegun", "Handbook of Mathematical Functions", "1964"
)
FITZGERALD = Cited(
    "Fitzgerald", "A. E. Fitzgerald, C. Kingsley, S. D. Umans", "Electric Machinery, 6th edition",
    "2003",
)  # fmt: skip

# --- standards ------------------------------------------------------------------------------------

IEC_61672_1 = Cited(
    "IEC 61672-1", "International Electrotechnical Commission", "Sound level meters, part 1", "2013"
)
ISO_3744 = Cited("ISO 3744", ISO, "Sound power from sound pressure, engineering methods", "2010")
ISO_3741 = Cited("ISO 3741", ISO, "Sound power in reverberation test rooms", "2010")
PHONOMETRY = Cited(
    "phonometry", "J. M. Requena-Plens (MIT licence)", "phonometry, test sheet for ISO 3744",
    "version 3.3.0",
)  # fmt: skip
ISO_PAS_20065 = Cited(
    "ISO/PAS 20065", ISO, "Audibility of tones in noise, as phonometry quotes it", "2016"
)
DIN_45681 = Cited(
    "DIN 45681", "Deutsches Institut für Normung",
    "Tonal components of noise, as phonometry quotes it", "2005",
)  # fmt: skip
ISO_532_1 = Cited("ISO 532-1", ISO, "Loudness by Zwicker's method, as MoSQITo cites it", "2017")
DIN_45692 = Cited(
    "DIN 45692", "Deutsches Institut für Normung",
    "Sensation of sharpness, as MoSQITo cites it", "2009",
)  # fmt: skip
ECMA_418_1 = Cited(
    "ECMA-418-1", "Ecma International", "Prominent discrete tones", "edition not stated"
)
ISO_9613_1 = Cited("ISO 9613-1", ISO, "Absorption of sound by the atmosphere", "1993")
ISO_389_7 = Cited("ISO 389-7", ISO, "Reference threshold of hearing", "edition not stated")
TA_LAERM = Cited(
    "TA Lärm", "German federal government", "Technische Anleitung zum Schutz gegen Lärm", "1998"
)

# --- codes and recordings -------------------------------------------------------------------------

ROSS = Cited("ROSS", "ross-rotordynamics", "Rotordynamic Open-Source Software", "version 2.3.0")
PDSIM = Cited("PDSim", "I. Bell", "PDSim, scroll/core.py", "version not stated")
KWAVE = Cited("k-Wave", "B. E. Treeby and others", "k-Wave-python", "version 0.6.2")
MOSQITO = Cited("MoSQITo", "Eomys", "electric_motor_vibration.uff and its package", "2021")
