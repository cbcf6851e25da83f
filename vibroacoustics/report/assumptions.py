"""Where the inputs come from, what is not modelled, and the errors of the source."""

from typing import Any, Final

import numpy as np
import xarray as xr

from . import rounding
from .bands import Band, band_words
from .study import catalogue_receiver, has_inner_sources, overall_noise, parameters
from .tables import Table

ASSUMED: Final = "assumed"

LOUD_LINE_BELOW_TOTAL_DB: Final = 11.0
"""A pessimistic structure-borne 1x line: 45 of 56 dB(A)."""

RIGID_SHELL: Final = (
    "The shell is rigid. Its elastic modes and the gas, contact and bearing forces that drive them "
    "are not modelled; these forces are internal and do not shake the "
    "rigid machine, but they make most of its sound.",
)

ELASTIC_SHELL: Final = (
    "Gas forces, Oldham keys and motor torque drive the modes of an elastic shell, which is empty: "
    "machine, oil and gas inside are not in its modes, but for a range of their frequencies and "
    "mobility. Bearing housing, fixed scroll and stator are rigid and touch the shell at welds "
    "only; feet, tubes and terminal box are left out.",
    "Contact of the wraps' flanks and tips, noise of the bearings, magnetic forces of the motor "
    "other than its torque, the flow through the discharge port and sound in the gas of the shell "
    "are not modelled; they are part of the remainder.",
)
"""Instead of RIGID_SHELL where inner sources are modelled."""

NOT_MODELLED: Final = (
    "Gas pulsation in the suction and discharge pipes is not modelled.",
    "Structure-borne sound is not modelled: the forces into the feet are reported, the floor, "
    "panel and pipes that they would excite are not. A change of the foot force may be heard "
    "there before it is heard through the air.",
    "The floor is rigid for the mounts and hard for the sound; there are no other walls. The "
    "scattering of sound between shell and floor is included.",
    "Levels hold at the study's microphones; a rocking machine sounds louder in other directions.",
    "The weight of moving parts times their sideways shift is left out of the moment: some mN m.",
)

NOT_MODELLED_OF_KIND: Final = {
    "minicrank-scroll": (
        "Links and bearings are rigid and without clearance where there is one mini-crank. It then "
        "rocks, and the scroll swings by some 4°, which the wraps forbid: the torque peaks and pin "
        "forces of such an option are those of the paper's model, not of a machine.",
        "Three mini-cranks hold the scroll on equal elastic pins, quasi-statically and to first "
        "order in the errors; the first has the errors, the others fit the crank.",
        "The gas load has one harmonic; twice-line torque of the motor is not modelled. The "
        "weight of what link errors leave unbalanced on the shaft is left out of its torque: "
        "some mN m.",
    ),
    "oldham-scroll": (
        "Both bobs of a pendulum option are taken on the same side, so that their vertical forces "
        "add; on opposite sides the vertical 1× force would cancel. Stops are not modelled.",
        "A weight on the shaft turns: it lowers the force along the stroke of the ring and makes "
        "one across it. The machine's own counterweights may already hold part of it; they are "
        "taken to balance scroll, pin and brake only.",
        "A sprung mass is tuned to one speed.",
    ),
    "slider-link": (
        "Start and stop, in which the block swings widely on its springs, and knocks of the block "
        "against the shell are not modelled; springs and discharge tube are linear and without "
        "mass, so that their own resonances are missing.",
        "Sound and force that pass from the block to the shell through gas and oil are left out: "
        "above some hundred hertz they can carry more than the springs.",
        "A weight on the shaft turns: it lowers the force along the stroke and makes one across "
        "it. It adds to the shaft's own counterweight, which holds the slider and a part of the "
        "piston already. The couple of an option's weights about the block's centre of mass is "
        "included, their share in its mass and inertia is not.",
        "The motor's torque falls linearly with the speed; its pulsation at twice the line "
        "frequency is not modelled.",
    ),
    "hermetic-reciprocating": (
        "Friction of the piston and drag of the oil films are left out, as in the paper: the shaft "
        "power is that of the gas and of the films that are squeezed.",
        "The springs of the block are linear and meet no stops; the weight of the block, start and "
        "stop are not modelled. The tube has no mass, hence no resonance of its own.",
        "The valves open without loss, and the gas in the shell, which carries sound from the "
        "block to the shell, is not modelled.",
        "An option that puts weights on the shaft leaves the films as they are; a redesign of the "
        "crank has its own.",
    ),
    "reciprocating": (
        "One cylinder stands for the machine. The crankshaft is balanced about its axis, the big "
        "end of the rod is not; the paper gives no counterweight. Lanchester's weights are in "
        "the plane of the cylinder's axis, without the moment of their gears.",
    ),
}
"""What each kind of machine leaves out besides."""

_WITHOUT_INSIDE: Final = (
    "A second ring has no gas force that presses its keys: they are likely to rattle, which can be "
    "louder than the 1× line that it removes.",
    "The shaft turns at constant speed; torque ripple, twice-line torque of the motor and key slap "
    "are not modelled.",
)
_WITH_INSIDE: Final = (
    "Forces of the moving parts and keys are those at constant speed; torque ripple and the "
    "motor's torque act on stator and machine only. The ring's keys strike along a clearance and "
    "its bodies are rigid; all four have the same clearance, friction and stiffness.",
)
_OF_SCROLL: Final = {False: _WITHOUT_INSIDE, True: _WITH_INSIDE}
"""What a scroll leaves out, without and with inner sources."""


def not_modelled(results: xr.Dataset) -> tuple[str, ...]:
    """What the results leave out, one sentence or two each."""
    kind, inside = parameters(results)["machine"]["kind"], has_inner_sources(results)
    of_scroll = _OF_SCROLL[inside] if kind == "oldham-scroll" else ()
    of_shell = ELASTIC_SHELL if inside else RIGID_SHELL
    return (*of_shell, *NOT_MODELLED, *NOT_MODELLED_OF_KIND.get(kind, ()), *of_scroll)


def records_table(results: xr.Dataset) -> Table:
    """Every recorded value, the assumed ones first."""
    records = parameters(results)["records"]
    ordered = sorted(records, key=lambda record: not _is_assumed(record))
    head = ("Value of", "Value", "Unit", "Range", "Source", "File")
    rows = tuple(_record_row(record) for record in ordered)
    return Table("Inputs with their sources", head, rows, frozenset({0, 2, 4, 5}))


def assumed_count(results: xr.Dataset) -> tuple[int, int]:
    """Number of assumed values, and of all recorded values."""
    records = parameters(results)["records"]
    return sum(_is_assumed(record) for record in records), len(records)


def errata_table(results: xr.Dataset) -> Table | None:
    """Errors in the source document; None if none are listed."""
    errata = parameters(results)["machine"]["errata"]
    rows = tuple((entry["item"], entry["printed"], entry["finding"]) for entry in errata)
    head = ("Item", "As printed", "Finding")
    return Table("Errata of the source", head, rows, frozenset({0, 1, 2})) if rows else None


def remainder_sentence(results: xr.Dataset) -> str:
    """How the part of the level that the model does not explain is fixed."""
    noise = overall_noise(results)
    assumed = any(
        record["field"].endswith("overall_noise.level_dba") and _is_assumed(record)
        for record in parameters(results)["records"]
    )
    who = "The catalogue gives" if not assumed else "The level of the whole machine is assumed:"
    if has_inner_sources(results):
        rest = Band(*map(float, results["inner_remainder_level"].values))
        left = f"{rest.ends(rounding.fixed)} dB(A) ({band_words(results)} of the draws)"
    else:
        left = f"{rounding.fixed(results['level_remainder'].item(), 3)} dB(A)"
    return (
        f"{who} {noise['level_dba']:g} dB(A) at {noise['distance_m']:g} m and "
        f"{noise['speed_rpm']:g} rpm. What the model leaves of it at {catalogue_receiver(results)} "
        f"without a balancer, {left}, is "
        "added as energy to the modelled level at every speed, option and microphone. That it "
        "stays constant is an assumption, not a result."
    )


def structure_borne_sentence(results: xr.Dataset) -> str:
    """What removing a line would buy, were it far louder through the feet than through the air."""
    total = overall_noise(results)["level_dba"]
    gain = 10.0 * np.log10(1.0 - 10.0 ** (-LOUD_LINE_BELOW_TOTAL_DB / 10.0))
    return (
        f"To see what such sound could change: a 1× line of {total - LOUD_LINE_BELOW_TOTAL_DB:g} "
        f"dB(A), far above the airborne one, removed altogether, would lower {total:g} dB(A) by "
        f"{rounding.fixed(abs(gain), 2)} dB."
    )


def _is_assumed(record: dict[str, Any]) -> bool:
    return str(record["source"]).startswith(ASSUMED)


def _record_row(record: dict[str, Any]) -> tuple[str, ...]:
    return (
        record["field"],
        record["value"].replace("-", "−"),
        record["unit"] or "1",
        _range(record),
        record["source"],
        record["file"],
    )


def _range(record: dict[str, Any]) -> str:
    if record["lowest"] is None:
        return rounding.NOTHING
    return f"{record['lowest']:g} to {record['highest']:g}".replace("-", "−")
