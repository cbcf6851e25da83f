"""The units that every study may use: one line each."""

from ..registry import register
from . import Unit

for _unit in (
    Unit("um", "µm", "m", 1e-6),
    Unit("mm", "mm", "m", 1e-3),
    Unit("cm", "cm", "m", 1e-2),
    Unit("m", "m", "m", 1.0),
    Unit("m2", "m²", "m2", 1.0),
    Unit("cm3", "cm³", "m3", 1e-6),
    Unit("m3", "m³", "m3", 1.0),
    Unit("g", "g", "kg", 1e-3),
    Unit("kg", "kg", "kg", 1.0),
    Unit("g_mm", "g mm", "kg_m", 1e-6),
    Unit("kg_m", "kg m", "kg_m", 1.0),
    Unit("kg_m2", "kg m²", "kg_m2", 1.0),
    Unit("n", "N", "n", 1.0),
    Unit("kn", "kN", "n", 1e3),
    Unit("n_per_mm", "N/mm", "n_per_m", 1e3),
    Unit("n_per_m", "N/m", "n_per_m", 1.0),
    Unit("ns_per_m", "N s/m", "ns_per_m", 1.0),
    Unit("m_per_ns", "m/(N s)", "m_per_ns", 1.0),  # of a mobility
    Unit("mm_per_ns", "mm/(N s)", "m_per_ns", 1e-3),
    Unit("m_per_n", "m/N", "m_per_n", 1.0),  # of a receptance
    Unit("um_per_n", "µm/N", "m_per_n", 1e-6),
    Unit("n_per_m1p5", "N/m^1.5", "n_per_m1p5", 1.0),  # of a Hertz contact
    Unit("mm_per_s", "mm/s", "m_per_s", 1e-3),
    Unit("m_per_s", "m/s", "m_per_s", 1.0),
    Unit("bar", "bar", "pa", 1e5),
    Unit("gpa", "GPa", "pa", 1e9),
    Unit("mpa", "MPa", "pa", 1e6),
    Unit("pa", "Pa", "pa", 1.0),
    Unit("kpa_s_per_m2", "kPa s/m²", "pa_s_per_m2", 1e3),  # of a flow resistivity
    Unit("pa_s_per_m2", "Pa s/m²", "pa_s_per_m2", 1.0),
    Unit("pa_s", "Pa s", "pa_s", 1.0),
    Unit("deg", "°", "rad", 0.017453292519943295),
    Unit("rad", "rad", "rad", 1.0),
    Unit("rad_per_s", "rad/s", "rad_per_s", 1.0),
    Unit("rad_per_s2", "rad/s²", "rad_per_s2", 1.0),
    Unit("ms", "ms", "s", 1e-3),
    Unit("s", "s", "s", 1.0),
    Unit("us", "µs", "s", 1e-6),
    Unit("hz", "Hz", "hz", 1.0),
    Unit("khz", "kHz", "hz", 1e3),
    Unit("v", "V", "v", 1.0),
    Unit("a", "A", "a", 1.0),
    Unit("vs", "V s", "vs", 1.0),
    Unit("t", "T", "t", 1.0),
    Unit("ohm", "Ω", "ohm", 1.0),
    Unit("mh", "mH", "h", 1e-3),
    Unit("h", "H", "h", 1.0),
    Unit("uf", "µF", "f", 1e-6),
    Unit("f", "F", "f", 1.0),
    Unit("kg_per_m3", "kg/m³", "kg_per_m3", 1.0),
    Unit("n_m", "N m", "n_m", 1.0),
    Unit("n_m_s", "N m s", "n_m_s", 1.0),
    Unit("w", "W", "w", 1.0),
    Unit("kw", "kW", "w", 1e3),
    Unit("kg_per_s", "kg/s", "kg_per_s", 1.0),
    Unit("rpm", "rpm", "rpm", 1.0),  # the label of a speed; see shaft_frequency_hz
    Unit("db", "dB", "db", 1.0),
    Unit("dba", "dB(A)", "dba", 1.0),
    Unit("eur", "€", "eur", 1.0),
    Unit("percent", "%", "ratio", 1e-2),
    Unit("ratio", "", "ratio", 1.0),
):
    register(_unit)
