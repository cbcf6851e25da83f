"""Speeds held against each other, and checked, in the order spectra that they make."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PPoly

from .comb_evidence import best_speeds, lines_in_place, sharpness
from .mains import mains_of
from .speed_profiles import Search, SpeedProfile
from .unrolled import Unrolled

MOSTLY: Final = 0.95
"""Share of a recording over which the orders of the shaft stand out."""
WIDE_LINE: Final = 1.2
"""Width of lines over that of a steady tone's that says that the speed was not followed."""
_SHARP_LINE: Final = 1.08
"""Width of a line of a speed that was followed."""
_LEAST_IN_PLACE: Final = 0.6
"""Share of the comb's orders that have a clear line where the speed is sure."""
_APART: Final = 0.004
"""Relative distance from which a speed is another one."""
_NEAR: Final = 0.02
"""Relative distance up to which speed profiles follow the same shaft."""
_CHANCE: Final = 5.0
"""Evidence that the best of all speeds gets where no shaft turns: about ln of the number of speeds
that can be separated, over which the best was looked for."""
_FRAMES: Final = (24, 12, 24, 48, 24, 12)
"""Revolutions of the frames in which a speed profile is refined, one after the other."""
_SHORT_SPECTRA: Final = 3.0
"""Evidence of the short spectra for the speed profile that explains them best."""
_CAUTION: Final = 2.0
"""Evidence that counts as a factor e of odds: the teeth are not independent of each other."""
_LOOKED_INTO: Final = 2
"""Scales of a speed profile of which it is known how long their orders stand out."""
_UNSURE: Final = 0.5
"""Confidence of a shaft that turns as fast as the mains, since hum has its lines, or whose lowest
orders vanish for a while."""
_LONGEST_LOSS: Final = 4
"""Frames in a row without the lowest orders: the length of one, as frames overlap."""
_LOST: Final = 8.0
"""Evidence that is lost with a factor e of time in which the orders do not stand out."""


@dataclass(frozen=True)
class SpeedCheck:
    """Certainty of a speed, from the order spectrum that it makes.

    Attributes
    ----------
    confidence : 0 to 1: evidence for the speed over that for it, for all others within the limits
        and for no shaft at all
    rival_hz : mean of the speed that explains the lines next best; None where there is none
    in_place : orders of the comb at which there is a clear line
    orders : orders of the comb that lie below half the sample rate
    width : mean width of those lines, by order, over that of a steady tone's
    followed : share of the recording in which the orders stand out as they mostly do
    mains_hz : where the speed never leaves that of the mains, whose hum has the same lines
    """

    confidence: float
    rival_hz: float | None
    in_place: int
    orders: int
    width: float
    followed: float
    mains_hz: float | None = None


@dataclass(frozen=True)
class _Hypothesis:
    """A speed profile at a scale, and the evidence for it."""

    profile: SpeedProfile
    scale: float
    evidence: float

    def scaled(self) -> SpeedProfile:
        curve = self.profile.curve
        return replace(self.profile, curve=PPoly(self.scale * curve.c, curve.x))


def checked_profile(
    search: Search, profiles: list[SpeedProfile]
) -> tuple[SpeedProfile, SpeedCheck]:
    """The speed profile with the most evidence in its order spectrum, at the scale that it asks
    for.

    A speed profile that follows the shaft makes its lines sharp, whichever of them it follows; the
    comb shows the scale. An even speed is a speed profile too. The best one is refined in the order
    spectra of short blocks. Rivals are other scales of it, and what other speed profiles explain of
    what is left when the lines of the best one are taken out.

    Parameters
    ----------
    search : settings of the search
    profiles : that explain the signal's short spectra
    """
    first = profiles[0]
    mean_hz = float(np.mean(first.curve(first.time_s)))
    even = PPoly(np.array([[mean_hz]]), first.time_s[[0, -1]])
    profiles = [*profiles, replace(first, curve=even)]
    hypotheses = [
        hypothesis for profile in profiles for hypothesis in _hypotheses(Unrolled(search, profile))
    ]
    if not hypotheses:
        return first, SpeedCheck(0.0, None, 0, search.orders.size, np.nan, 0.0)
    if (
        max(hypothesis.evidence for hypothesis in hypotheses) < _CHANCE
    ):  # too little to overrule short spectra
        hypotheses = [_Hypothesis(first, 1.0, 0.0)]
    hypotheses = [
        replace(hypothesis, evidence=hypothesis.evidence + _SHORT_SPECTRA)
        if hypothesis.profile is first and abs(np.log(hypothesis.scale)) < _APART
        else hypothesis
        for hypothesis in hypotheses
    ]
    best = _refined(search, hypotheses)
    at_scales = _hypotheses(best)
    nearest = [hypothesis for hypothesis in at_scales if abs(np.log(hypothesis.scale)) < _APART]
    if nearest:
        best = Unrolled(search, nearest[0].scaled())
    without_best = best.without_orders()
    others = [
        hypothesis
        for profile in profiles
        for hypothesis in _hypotheses(Unrolled(without_best, profile))
    ]
    rivals = [
        hypothesis
        for hypothesis in [*at_scales, *others]
        if _apart(hypothesis.scaled(), best.profile) > _APART
    ]
    near = [profile for profile in profiles[:-1] if _apart(profile, best.profile) < _NEAR]
    surest = max(near or [best.profile], key=lambda profile: float(np.mean(profile.confidence)))
    profile = replace(best.profile, confidence=surest.confidence)
    return profile, _check(best, nearest[0].evidence if nearest else -np.inf, rivals)


def _refined(search: Search, hypotheses: list[_Hypothesis]) -> Unrolled:
    """The speed profile of the most evidence, the sharpest one of it, of others near it, and
    refined."""
    best = max(hypotheses, key=lambda hypothesis: hypothesis.evidence).scaled()
    near = [hypothesis.scaled() for hypothesis in hypotheses if hypothesis.evidence > 0.0]
    near = [profile for profile in near if 0.0 < _apart(profile, best) < _APART]
    trials = [Unrolled(search, best)]
    for revolutions in _FRAMES:
        trials.append(Unrolled(search, trials[-1].polished(revolutions)))
    for profile in near:
        trials.append(Unrolled(search, profile))
        trials.append(Unrolled(search, trials[-1].polished()))
    rising = [trial for trial in trials if trial.is_rising]
    return max(rising or trials[:1], key=lambda trial: sharpness(trial.lines, search.orders))


def _hypotheses(unrolled: Unrolled) -> list[_Hypothesis]:
    """Scales of a speed profile that its order spectrum speaks for, the best one first."""
    search, profile = unrolled.search, unrolled.profile
    if not unrolled.is_rising or unrolled.lines.frequency.size == 0:
        return []
    speed = profile.curve(profile.time_s)
    lowest, highest = search.minimum_hz / speed.min(), search.maximum_hz / speed.max()
    pairs = zip(*best_speeds(unrolled.lines, search.orders, lowest, highest, _APART), strict=True)
    listed = []
    for number, (scale, evidence) in enumerate(pairs):
        share = unrolled.followed(scale) if number < _LOOKED_INTO else 1.0
        lost = _LOST * np.log(min(1.0, max(share, 0.01) / MOSTLY))
        # A speed profile that leaps from one multiple of the speed to another has its lines for a
        # time.
        present = _share(unrolled.low_lines(scale)) if evidence > 0.0 else 1.0
        listed.append(_Hypothesis(profile, float(scale), float(present * evidence + lost)))
    return sorted(listed, key=lambda hypothesis: -hypothesis.evidence)


def _share(stands_out: NDArray[np.bool_]) -> float:
    """Share of the time in which lines stand out, shape (order, frame); none without lines."""
    return float(stands_out.mean()) if stands_out.size else 0.0


def _longest_loss(stands_out: NDArray[np.bool_]) -> int:
    """Most frames in a row in which no line stands out, shape (order, frame)."""
    present = np.flatnonzero(np.concatenate([[True], stands_out.any(axis=0), [True]]))
    return int(np.max(np.diff(present))) - 1


def _apart(profile: SpeedProfile, other: SpeedProfile) -> float:
    """Relative distance of two speed profiles."""
    time_s = profile.time_s
    return float(np.median(np.abs(np.log(profile.curve(time_s) / other.curve(time_s)))))


def _check(best: Unrolled, worth: float, rivals: list[_Hypothesis]) -> SpeedCheck:
    distinct: list[_Hypothesis] = []
    for rival in sorted(rivals, key=lambda rival: -rival.evidence):
        if all(_apart(rival.scaled(), other.scaled()) > _APART for other in distinct):
            distinct.append(rival)
    against = np.array([_CHANCE, *(rival.evidence for rival in distinct)])
    odds = np.exp(np.clip((against - worth) / _CAUTION, -50.0, 50.0))
    in_place, orders, width = lines_in_place(best.lines, best.search.orders)
    followed = best.followed()
    certainty = min(1.0, followed / MOSTLY) * min(
        1.0, in_place / (_LEAST_IN_PLACE * max(orders, 1))
    )
    certainty *= min(1.0, _SHARP_LINE / width) ** 4 if in_place else 0.0
    certainty *= _UNSURE if _longest_loss(best.low_lines()) > _LONGEST_LOSS else 1.0
    time_s = best.profile.time_s
    mains_hz = mains_of(best.profile.curve(time_s))
    certainty *= 1.0 if mains_hz is None else _UNSURE
    return SpeedCheck(
        confidence=float(certainty / (1.0 + odds.sum())),
        rival_hz=float(np.mean(distinct[0].scaled().curve(time_s))) if distinct else None,
        in_place=in_place,
        orders=orders,
        width=width,
        followed=followed,
        mains_hz=mains_hz,
    )
