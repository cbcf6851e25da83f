"""Cases that pictures show, without an option and with the first in rank; deflection."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import xarray as xr

from ..base.arrays import Array
from ..base.registry import register
from ..base.vocabulary import REFERENCE_OPTION, stamp
from ..levels.contribution_choice import chosen_speeds
from ..levels.energy import loudest_line
from ..levels.sample_levels import loads_with_gain, with_discrepancy
from ..machine.cases import Cases
from ..machine.machine import Machine
from ..machine.source import CaseKey, Shared
from ..mechanics.received_sound import ReceivedSound
from ..transfer.contributions import Transmission
from ..transfer.deflection import MovingCase, deflection_variables, section_variables
from .chain import Chain
from .representative import Representative
from .stage import Given, Stage

UNMODELLED_NOISE: Final = ("representative_unmodelled_band_level", "unmodelled_band_level")
"""Variables of the representative sample and with nominal values."""
SHOWN: Final[tuple[str | type, ...]] = (
    Cases, Transmission, Representative, "rank", *UNMODELLED_NOISE
)  # fmt: skip
"""Reads of a stage that asks for the cases; with the ranks it comes after the scores."""


@dataclass(frozen=True)
class Shown:
    """Cases at the speed of the published level, of the representative sample if there is one.

    Attributes
    ----------
    speed_rpm : the nearest to that of the published level
    options : none, and the one that ranks first
    receiver : number of the microphone of the published level
    machine : without an option
    cases : cases of these options
    gain : factors of the discrepancy on the power of sources, shape (source, receiver, gain band);
        empty without samples
    unmodelled : level of unmodelled noise, (option, receiver, noise_band), dB
    """

    speed_rpm: float
    options: tuple[str, ...]
    receiver: int
    machine: Machine
    cases: Cases
    gain: Mapping[CaseKey, Array]
    unmodelled: xr.DataArray

    @classmethod
    def of(cls, chain: Chain) -> "Shown":
        """Choose the cases of a study."""
        study, chosen = chain.study, chain.get(Representative)
        speed = min(chosen_speeds(study), key=lambda rpm: abs(rpm - study.catalogue_speed_rpm))
        options = tuple(dict.fromkeys([REFERENCE_OPTION, *_first_ranked(chain.results)]))
        every = chain[Cases] if chosen is None else chosen.cases
        return cls(
            speed,
            options,
            list(study.receivers).index(study.catalogue_receiver),
            study.machine if chosen is None else chosen.machine,
            every.some((speed, option) for option in options),
            {} if chosen is None else chosen.gain,
            chain.results[UNMODELLED_NOISE[chosen is None]].sel(speed=speed, option=list(options)),
        )

    def received(self, path: Transmission, receiver: int | None = None) -> list[ReceivedSound]:
        """Compute the sound of each case, with the discrepancy of the sample.

        Parameters
        ----------
        path : to receivers
        receiver : number of the microphone whose discrepancy all receivers have; each its own
            without it
        """
        rows = slice(None) if receiver is None else [receiver]
        return [
            with_discrepancy(case, self.gain[key][:, rows]) if self.gain else case
            for key, case in path.received(self.cases).items()
        ]


def _first_ranked(results: xr.Dataset) -> list[str]:
    """Name of the option that ranks first; empty in a trial, which has no scores."""
    ranks = [results["rank"].isel(scoring_method=0)] if "rank" in results else []
    return [str(rank["option"].values[rank.argmin("option").item()]) for rank in ranks]


@register
class Deflection(Stage):
    """Displacement of rings around the shell, of the feet and of the rigid body; forces."""

    name = "deflection"
    reads = (*SHOWN, "pressure_line")
    gives = ("shown_speed", "deflection*", "section_force")

    def run(self, chain: Chain) -> Given:
        shown, transmission = Shown.of(chain), chain[Transmission]
        pressure = chain.results["pressure_line"].sel(receiver=chain.study.catalogue_receiver)
        cases, louder = {}, {}
        for (speed, option), case in shown.cases.cases.items():
            key, loads = (speed, option), shown.cases.loads[speed, option]
            lines, gain = transmission.lines(key, shown.cases), shown.gain.get(key)
            path = transmission.path(Shared(), case.machine, loads)
            loudest = loudest_line(pressure.sel(speed=speed, option=option))
            cases[option] = MovingCase(path, lines, loudest)
            if gain is not None:
                lines = loads_with_gain(lines, gain[:, shown.receiver])
            louder[option] = cases[option]._replace(lines=lines)
        results = deflection_variables(louder, shown.machine.shell)
        results = results.merge(section_variables(cases, shown.machine))
        return Given(results.assign(shown_speed=stamp("shown_speed", shown.speed_rpm)))
