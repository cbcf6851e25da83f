"""Figures of two results against their limits: totals, bands, orders from below, criteria."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

import numpy as np
import xarray as xr

from ..base.arrays import Array
from ..base.constants import REFERENCE_PRESSURE_PA
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from ..base.vocabulary import REFERENCE_OPTION
from ..recordings.quantities import quantity
from ..study.criterion import CRITERIA, label_and_unit
from .criterion_values import criterion_values
from .estimates import in_samples, is_sampled, sample_weights
from .figure_limit import EVERY_CHANNEL, HIGHEST, PRESSURE_UNIT, WEIGHTED, FigureLimit
from .order_comparison import ORDER_TOLERANCE, channel_units, listed

PRESSURE: Final = "pressure "
"""Prefix of the channels of a study that are microphones."""


class CheckedFigure(NamedTuple):
    """A figure of one of two results beside its limit; values are in the limit's unit.

    Attributes
    ----------
    result, figure, speed_rpm : which; the speed is not a number where the figure is of all
    value, limit, unit, side, margin : beside the limit
    origin : file and line of the limit
    probability : that the limit holds, of a total or a criterion of a study with samples; else not
        a number
    """

    result: str
    figure: str
    speed_rpm: float
    value: float
    limit: float
    unit: str
    side: str
    margin: float
    origin: str
    probability: float = float("nan")

    @property
    def is_within(self) -> bool:
        """Whether the limit holds."""
        return self.margin >= 0.0


class Compared(NamedTuple):
    """Two results and what was compared of them.

    Attributes
    ----------
    orders : result of `compare`
    first, second : results of `run`, `analyse_orders` or `mean_of_runs`
    """

    orders: xr.Dataset
    first: xr.Dataset
    second: xr.Dataset

    def sides(self) -> Iterator[tuple[str, xr.Dataset, str, str]]:
        """Letter, result, option, and the name of its channels in the comparison."""
        attrs = self.orders.attrs
        option = str(attrs.get("option", REFERENCE_OPTION))
        yield "A", self.first, option, "channel"
        yield "B", self.second, str(attrs.get("other_option", option)), "compared_channel"


def check_figures(compared: Compared, limits: Sequence[FigureLimit]) -> list[CheckedFigure]:
    """Hold figures of both results against their limits."""
    return [row for limit in limits for row in _checked(compared, limit)]


def _checked(compared: Compared, limit: FigureLimit) -> list[CheckedFigure]:
    channels = [] if limit.criterion else _channels(compared.orders, limit)
    rows = [
        CheckedFigure(
            letter, subject, speed, value, limit.limit, limit.unit, limit.side,
            limit.margin(value), limit.origin, probability,
        )
        for letter, result, option, names in compared.sides()
        for subject, speed, value, probability in _values(
            compared.orders, result, option, names, limit, channels
        )
        if np.isfinite(value) and _holds(limit, speed)
    ]  # fmt: skip
    if not rows:
        raise ParameterError(
            f"{limit.origin}: {limit.subject}: neither result has such a figure{_lacking(limit)}"
        )
    return rows


def _holds(limit: FigureLimit, speed: float) -> bool:
    """Whether a limit is for a speed; what has none is of all speeds."""
    rounded = np.rint(speed)
    return bool(np.isnan(speed) or limit.speed_from_rpm <= rounded <= limit.speed_to_rpm)


def _channels(orders: xr.Dataset, limit: FigureLimit) -> list[int]:
    """Rows of the compared channels that a limit is for."""
    units = channel_units(orders)
    names = [orders[name].values for name in ("channel", "compared_channel")]
    unit_of_all = PRESSURE_UNIT if limit.unit in WEIGHTED else quantity(limit.unit).unit
    rows = [
        row
        for row, unit in enumerate(units.values())
        if limit.channel in (EVERY_CHANNEL, *(str(column[row]) for column in names))
        and unit == unit_of_all
    ]
    if not rows:
        raise ParameterError(
            f"{limit.origin}: channel = {limit.channel!r}, in {limit.unit}: must be one of "
            f"{listed(units)}"
        )
    return rows


Values = Iterator[tuple[str, float, float, float]]
"""Subject, speed (not a number where it is of all), value in the limit's unit, and the probability
that the limit holds (not a number where it is not known)."""
_UNKNOWN: Final = float("nan")


def _values(
    orders: xr.Dataset,
    result: xr.Dataset,
    option: str,
    names: str,
    limit: FigureLimit,
    channels: Sequence[int],
) -> Values:
    if limit.criterion:
        yield from _criterion(result, option, limit)
    for row in channels:
        channel = str(orders[names].values[row])
        if limit.figure == "order":
            yield from _orders(orders.isel(channel=row), names, channel, limit)
        elif "force_order" in result:
            yield from _of_study(result, option, channel, limit)
        else:
            yield from _of_recording(result, channel, limit)


def _orders(figures: xr.Dataset, names: str, channel: str, limit: FigureLimit) -> Values:
    name = "channel_order_rms" if names == "channel" else "compared_order_rms"
    columns = np.flatnonzero(
        np.abs(figures["order"].values - (limit.order or 0.0)) < ORDER_TOLERANCE
    )
    for speed, rms in zip(figures["speed"].values, figures[name].values[:, columns], strict=True):
        for value in rms:
            level = float(level_of_amplitude(value / REFERENCE_PRESSURE_PA))
            value_in_unit = limit.in_unit(value, level)
            yield f"order {limit.order:g} of {channel}", speed, value_in_unit, _UNKNOWN


def _of_study(result: xr.Dataset, option: str, channel: str, limit: FigureLimit) -> Values:
    """A-weighted totals and bands of the machine; other totals are of the modelled sound."""
    receiver = channel.removeprefix(PRESSURE)
    subject = limit.subject.replace(limit.channel, channel)
    if limit.figure == "band":
        if "total_band_level" in result and limit.band_hz in result["noise_band"].values:
            level = result["total_band_level"].sel(
                option=option, receiver=receiver, noise_band=limit.band_hz
            )
            yield from _by_speed(subject, level["speed"].values, level.values)
        return
    weighting = WEIGHTED[limit.unit]
    level = result["level_total"]
    if weighting != "A":
        level = result["level_modelled"].sel(weighting=weighting)
    of_option = level.sel(option=option, receiver=receiver)
    chances: Array | None = None
    if weighting == "A" and is_sampled(result, "level_total"):
        total = in_samples(result, "level_total")
        rows = total.values.sel(option=option, receiver=receiver).values
        chances = _chances(limit, rows, total.weight)
    yield from _by_speed(subject, of_option["speed"].values, of_option.values, chances)


def _of_recording(result: xr.Dataset, channel: str, limit: FigureLimit) -> Values:
    """Equivalent levels over all of the recording."""
    coordinates = {"channel": channel, "weighting": WEIGHTED[limit.unit]}
    name = "band_level" if limit.figure == "band" else "equivalent_level"
    if name not in result:
        return
    level = result[name].sel(coordinates)
    if limit.figure == "band":
        level = level.isel(band=np.flatnonzero(level["band"].values == limit.band_hz))
    for value in np.atleast_1d(level.values):
        yield limit.subject.replace(limit.channel, channel), _UNKNOWN, float(value), _UNKNOWN


def _by_speed(subject: str, speeds: Array, values: Array, chances: Array | None = None) -> Values:
    chance_of_speed = np.full(len(speeds), _UNKNOWN) if chances is None else chances
    for speed, value, chance in zip(speeds, values, chance_of_speed, strict=True):
        yield subject, float(speed), float(value), float(chance)


def _criterion(result: xr.Dataset, option: str, limit: FigureLimit) -> Values:
    """Value of a criterion that the results give, whether the study scores it or not."""
    name = limit.criterion
    if name in CRITERIA:
        yield from _computed(result, option, limit)
    elif "criterion_value" in result and name in result["criterion"].values:
        value = result["criterion_value"].sel(criterion=name, option=option)
        _check_unit(limit, str(value["criterion_unit"].item()))
        yield limit.subject, _UNKNOWN, float(value), _UNKNOWN


def _computed(result: xr.Dataset, option: str, limit: FigureLimit) -> Values:
    """Value of a registered criterion; nothing of results that lack what it needs."""
    name = limit.criterion
    try:
        with CRITERIA.fenced(name, ParameterError):
            computed = criterion_values(result, name)
    except ParameterError:
        return
    _check_unit(limit, label_and_unit(name, unit=CRITERIA[name].unit)[1])
    row, chance = result["option"].values.tolist().index(option), _UNKNOWN
    if computed.by_sample is not None:
        chance = float(_chances(limit, computed.by_sample[:, row], sample_weights(result)))
    yield limit.subject, _UNKNOWN, float(computed.values[row]), chance


def _chances(limit: FigureLimit, by_sample: Array, weight: Array) -> Array:
    """Weight of the samples, shape (sample, ...), in which a limit holds."""
    holds = by_sample <= limit.limit if limit.side == HIGHEST else by_sample >= limit.limit
    return np.asarray(weight @ holds)


def _check_unit(limit: FigureLimit, unit: str) -> None:
    if unit != limit.unit:
        raise ParameterError(
            f"{limit.origin}: unit = {limit.unit!r}: criterion {limit.criterion} is in {unit}"
        )


def _lacking(limit: FigureLimit) -> str:
    """Say what a study needs for a criterion; nothing where it needs nothing."""
    criterion = CRITERIA.get(limit.criterion)
    return f"; it {criterion().needed}" if criterion and criterion.table else ""
