"""Orders of one result against those of another: simulated, recorded, or one of each."""

from collections.abc import Mapping
from itertools import product
from typing import Any, Final, TypeAlias

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..base.arrays import Array, ComplexArray, IndexArray
from ..base.decibel import level_of_amplitude
from ..base.errors import ParameterError
from ..base.vocabulary import NO_ANGLE_ZERO, REFERENCE_OPTION, check, label_coordinates, stamp
from .provenance import software_attributes

SPEED_TOLERANCE: Final = 0.02
"""Speeds of the two results that differ by less than this share are the same operating point."""
NEGLIGIBLE: Final = 1e-9
"""Share of the largest order of the same unit in a result: a smaller simulated order is rounding
(spectra of accelerations are good to about 1e-11), and no recorder has a range of 180 dB."""
ORDER_TOLERANCE: Final = 1e-6
Orders: TypeAlias = xr.DataArray | xr.Dataset


def compare(
    first: xr.Dataset,
    second: xr.Dataset,
    pairs: Mapping[str, str] | None = None,
    option: str = REFERENCE_OPTION,
    tacho_angle_rad: float = 0.0,
    other_option: str | None = None,
) -> xr.Dataset:
    """Order by order, in level and phase, at the speeds that both results have.

    Parameters
    ----------
    first, second : results of `run` or of `analyse_orders`
    pairs : channel of the second for each channel of the first; without it, those of one name
    option : the balancing option of a study that is compared
    tacho_angle_rad : crank angle of the first result at which the second's tacho gives its pulse
    other_option : that of the second, where it is another one

    Returns
    -------
    `channel_order` of the first, `compared_order` of the second turned to the first's crank angle,
    `order_difference` (dB) and `order_phase_difference` (rad, within ±π), each (channel, speed,
    order), not a number where one of the two has no such order (`NEGLIGIBLE`); no phase difference
    where a recording has too few blocks, and none at all where one has no mark on the shaft as its
    angle zero, whose peaks then are √2 times the RMS in the orders' bands. `channel_order_rms` and
    `compared_order_rms` are the RMS in the orders' bands, of a study the peaks over √2.
    `channel_order_coherence` is the lower of the two; coordinates `compared_speed` and
    `compared_channel`.

    Raises
    ------
    ParameterError
        The results have no channel, unit, order or speed in common, or the angle is not finite.

    Examples
    --------
    >>> def orders_of(peak):
    ...     tone = peak * np.cos(2.0 * np.pi * 50.0 * np.arange(4096) / 1024.0)
    ...     recording = va.label_recording([tone], 1024.0, ["ring"], ["m/s²"])
    ...     settings = va.OrderAnalysis(va.NominalSpeed(3000.0), (1.0,), maximum_order=4.0)
    ...     return va.analyse_orders(recording, settings)
    >>> compared = va.compare(orders_of(1.0), orders_of(2.0))
    >>> compared["order_difference"].item()  # dB
    6.02...
    """
    if not np.isfinite(tacho_angle_rad):
        raise ParameterError(f"tacho_angle = {tacho_angle_rad:g}: must be a finite angle")
    if other_option is not None and "option" not in second.coords:
        raise ParameterError(f"other option {other_option!r}: {_title(second)} has no options")
    other_option = option if other_option is None else other_option
    ours, theirs = channel_orders(first, option), channel_orders(second, other_option)
    names = _pairs(ours, theirs, pairs)
    order = common_orders(ours, theirs)
    points, other_points = common_points(ours, theirs).T
    chosen = {"channel": list(names), "speed": points, "order": order}
    other_chosen = {"channel": list(names.values()), "speed": other_points, "order": order}
    here = {**chosen, "speed": ours["speed"].values[points]}
    reference, other = values_at(ours, chosen), values_at(theirs, other_chosen)
    turned = other * np.exp(-1j * order * tacho_angle_rad)
    is_comparable = ~(_negligible(ours, chosen) | _negligible(theirs, other_chosen))
    with np.errstate(divide="ignore", invalid="ignore"):  # of what is not known
        level = level_of_amplitude(np.abs(turned) / np.abs(reference))
    coherence = np.minimum(_coherence(first, chosen), _coherence(second, other_chosen))
    has_phase = is_comparable & np.isfinite(coherence)
    has_phase &= NO_ANGLE_ZERO not in (_angle_zero(first), _angle_zero(second))
    values = {
        "channel_order": reference,
        "compared_order": turned,
        "order_difference": np.where(is_comparable, level, np.nan),
        "order_phase_difference": np.where(has_phase, _phase(turned, reference), np.nan),
        "channel_order_rms": _rms(first, ours, chosen),
        "compared_order_rms": _rms(second, theirs, other_chosen),
        "channel_order_coherence": coherence,
    }
    compared = xr.Dataset(
        {name: stamp(name, value, here) for name, value in values.items()},
        coords={
            "compared_speed": ("speed", theirs["speed"].values[other_points]),
            **_branches(ours, theirs, points, other_points),
            "channel_unit": ("channel", [channel_units(ours)[name] for name in names]),
            "compared_channel": ("channel", other_chosen["channel"]),
        },
    )
    compared.attrs = _attributes(first, second, (option, other_option), tacho_angle_rad)
    return check(label_coordinates(compared))


def channel_orders(result: xr.Dataset, option: str = REFERENCE_OPTION) -> xr.DataArray:
    """Complex peaks (channel, speed, order) of a result with `channel_unit`.

    A study's channels are named by what they are and where: `pressure NAME`, `force x`,
    `moment x`, `foot force NAME x`; `velocity tx` and `acceleration tx` of the centre of mass;
    `foot velocity NAME x` and `foot acceleration NAME x`.

    Raises
    ------
    ParameterError
        The result holds no orders, or not that option.
    """
    if "channel_order" in result:
        return _recorded(result)
    if "force_order" not in result:
        raise ParameterError(f"{_title(result)}: holds no orders; give results of run or orders")
    options = [str(name) for name in result["option"].values]
    if option not in options:
        raise ParameterError(f"option {option!r}: is none of {', '.join(options)}")
    chosen = result.sel(option=option)
    parts = [_named(_by_order(chosen, variable), word, unit) for variable, word, unit in _SIMULATED]
    velocity = chosen["velocity_order"].sum("source")
    translation = velocity.sel(dof=[name for name in velocity["dof"].values if name[0] == "t"])
    pulsation = 2j * np.pi * result["order_frequency"]
    moving = [("", translation)]
    if "foot_position" in result.coords:
        moving.append(("foot ", _foot_velocity(velocity, result["foot_position"])))
    for word, values in moving:
        parts.append(_named(values, f"{word}velocity", "m/s"))
        parts.append(_named(values * pulsation, f"{word}acceleration", "m/s²"))
    return xr.concat(parts, "channel")


def _foot_velocity(velocity: xr.DataArray, position: xr.DataArray) -> xr.DataArray:
    """Velocity v + w × r of the feet as parts of the rigid housing, m/s."""
    axes = {"axis": position["axis"].values}
    translated, turned = (
        velocity.sel(dof=[f"{kind}{axis}" for axis in axes["axis"]]).rename(dof="axis")
        .assign_coords(axes)
        for kind in "tr"
    )  # fmt: skip
    motion = translated + xr.cross(turned, position.reset_coords(drop=True), dim="axis")
    return motion.transpose("foot", "axis", ...)


def _recorded(result: xr.Dataset) -> xr.DataArray:
    """Coherent means of a recording; without a mark on the shaft, peaks from the RMS in the bands.

    There the angle drifts against the orders, and their coherent means are too low.
    """
    if _angle_zero(result) != NO_ANGLE_ZERO:
        return result["channel_order"]
    rms = result["channel_order_rms"]
    return rms.copy(data=np.sqrt(2.0) * rms.values.astype(complex)).rename("channel_order")


_SIMULATED: Final = (
    ("pressure_line", "pressure", "Pa"),
    ("force_order", "force", "N"),
    ("moment_order", "moment", "N m"),
    ("foot_force_order", "foot force", "N"),
)


def _by_order(study: xr.Dataset, variable: str) -> xr.DataArray:
    """A variable by shaft order, of all that makes it."""
    values = study[variable]
    if "line" not in values.dims:
        return values.sum("source")
    lines = values.isel(line=slice(0, study.sizes["order"])).sum("sound_source")  # orders first
    plain = lines.drop_vars(("line", "line_order", "tone_frequency"))
    return plain.rename(line="order").assign_coords(order=study["order"])


def _named(values: xr.DataArray, word: str, unit: str) -> xr.DataArray:
    """Values (speed, ..., order) as channels (channel, speed, order)."""
    other_dims = [dim for dim in values.dims if dim not in ("speed", "order")]
    names = [
        " ".join([word, *coordinate_words])
        for coordinate_words in product(*(values[dim].values for dim in other_dims))
    ]
    flat = values.transpose(*other_dims, "speed", "order").values
    coords = {
        "channel": names,
        "speed": values["speed"].values,
        "order": values["order"].values,
        "channel_unit": ("channel", [unit] * len(names)),
    }
    return stamp("channel_order", flat.reshape(len(names), *flat.shape[-2:]), coords)


def _pairs(
    ours: xr.DataArray, theirs: xr.DataArray, pairs: Mapping[str, str] | None
) -> dict[str, str]:
    """Channel of the second by that of the first, both there and of one unit."""
    units, other_units = (channel_units(result) for result in (ours, theirs))
    chosen = dict(pairs) if pairs else {name: name for name in units if name in other_units}
    if not chosen:
        raise ParameterError(
            f"no channel has the same name in both: {listed(units)} against "
            f"{listed(other_units)}; pair them, as in --pair "
            f'"{next(iter(units))}={next(iter(other_units))}"'
        )
    for name, other in chosen.items():
        for wanted, channels in ((name, units), (other, other_units)):
            if wanted not in channels:
                raise ParameterError(
                    f"pair {name}={other}: no channel {wanted!r}; there are {listed(channels)}"
                )
        if units[name] != other_units[other]:
            raise ParameterError(
                f"pair {name}={other}: units differ, {units[name]} and {other_units[other]}"
            )
    return chosen


def channel_units(result: xr.DataArray | xr.Dataset) -> dict[str, str]:
    """Unit of each channel by its name."""
    names, units = (map(str, result[name].values) for name in ("channel", "channel_unit"))
    return dict(zip(names, units, strict=True))


def listed(units: Mapping[str, str]) -> str:
    """Channels with their units, as in a message."""
    return ", ".join(f"{name} [{unit}]" for name, unit in units.items())


def common_orders(ours: Orders, theirs: Orders) -> Array:
    """Orders that both have, without order 0."""
    order, other = (np.asarray(result["order"].values, dtype=float) for result in (ours, theirs))
    is_common = np.abs(order[:, None] - other).min(axis=1) < ORDER_TOLERANCE
    common: Array = order[is_common & (order > 0.0)]
    if not common.size:
        raise ParameterError(
            f"no order in common: {', '.join(map('{:g}'.format, order))} against "
            f"{', '.join(map('{:g}'.format, other))}"
        )
    return common


def common_points(ours: Orders, theirs: Orders) -> IndexArray:
    """Positions of operating points (pair, 2) within the tolerance, each the nearest to the other.

    Points of one branch are paired; where the results have no branch in common, those of any.
    """
    speed, other = (np.asarray(result["speed"].values, dtype=float) for result in (ours, theirs))
    branch, other_branch = branch_of_points(ours), branch_of_points(theirs)
    alike = branch[:, None] == other_branch
    if not alike.any():
        alike = np.ones_like(alike)
    distance = np.where(alike, np.abs(speed[:, None] - other), np.inf)
    pairs: list[tuple[int, int]] = []
    for name, other_name in dict.fromkeys(product(branch.tolist(), other_branch.tolist())):
        of_pair = np.ix_(*map(np.flatnonzero, (branch == name, other_branch == other_name)))
        nearest = distance[of_pair].argmin(axis=1)
        mutual = distance[of_pair].argmin(axis=0)[nearest] == np.arange(nearest.size)
        rows, columns = of_pair[0][mutual, 0], of_pair[1][0, nearest[mutual]]
        near = distance[rows, columns] <= SPEED_TOLERANCE * speed[rows]
        pairs += zip(rows[near].tolist(), columns[near].tolist(), strict=True)
    if not pairs:
        raise ParameterError(
            f"no speed in common within {100 * SPEED_TOLERANCE:g} %: "
            f"{', '.join(map('{:.0f}'.format, speed))} against "
            f"{', '.join(map('{:.0f}'.format, other))} rpm"
        )
    return np.array(sorted(pairs), dtype=np.intp)


def branch_of_points(result: Orders) -> NDArray[np.str_]:
    """Branch of each operating point of a recording, shape (speed,); empty without."""
    if "branch" not in result.coords:
        return np.full(result.sizes["speed"], "")
    return np.asarray(result["branch"].values, dtype=str)


def _branches(
    ours: Orders, theirs: Orders, points: IndexArray, other_points: IndexArray
) -> dict[str, Any]:
    """Coordinate `branch` of compared points, where a result has branches."""
    for result, of_result in ((ours, points), (theirs, other_points)):
        if "branch" in result.coords:
            return {"branch": ("speed", branch_of_points(result)[of_result])}
    return {}


def values_at(result: xr.DataArray, selection: Mapping[str, Any]) -> NDArray[Any]:
    """Values (channel, speed, order) at channels, positions of speeds, and orders of a result."""
    chosen = result.sel(channel=selection["channel"]).isel(speed=selection["speed"])
    chosen = chosen.sel(order=selection["order"], method="nearest", tolerance=ORDER_TOLERANCE)
    return np.asarray(chosen.transpose("channel", "speed", "order").values)


def _negligible(result: xr.DataArray, selection: Mapping[str, Any]) -> NDArray[np.bool_]:
    """Orders that are negligible beside the largest with their unit; order 0 does not count."""
    size = abs(result.where(result["order"] > 0.0, 0.0))
    largest = size.max(("speed", "order")).groupby("channel_unit").max()
    largest_of_unit = largest.sel(channel_unit=result["channel_unit"]).drop_vars("channel_unit")
    least = values_at(NEGLIGIBLE * largest_of_unit.broadcast_like(size), selection)
    return np.asarray(values_at(size, selection) <= least)


def _phase(values: ComplexArray, reference: ComplexArray) -> Array:
    """Phase of the values against the reference, within ±π; 0 exactly for equal ones."""
    difference = np.angle(values) - np.angle(reference)
    return np.asarray(difference - 2.0 * np.pi * np.rint(difference / (2.0 * np.pi)))


def _coherence(result: xr.Dataset, selection: Mapping[str, Any]) -> Array:
    """Coherence of a recording's orders; 1 for simulated ones."""
    if "channel_order_coherence" not in result:
        return np.ones([len(labels) for labels in selection.values()])
    return values_at(result["channel_order_coherence"], selection)


def _rms(result: xr.Dataset, orders: xr.DataArray, selection: Mapping[str, Any]) -> Array:
    """RMS in the bands of a recording's orders; of simulated ones from their peaks."""
    if "channel_order_rms" in result:
        return values_at(result["channel_order_rms"], selection)
    return np.asarray(np.abs(values_at(orders, selection)) / np.sqrt(2.0))


def _angle_zero(result: xr.Dataset) -> str:
    return str(result.attrs.get("angle_zero", "that of the mechanism"))


def _title(result: xr.Dataset) -> str:
    return str(result.attrs.get("source_file", result.attrs.get("title", "result")))


def _attributes(
    first: xr.Dataset, second: xr.Dataset, options: tuple[str, str], tacho_angle_rad: float
) -> dict[str, Any]:
    names: tuple[str, ...] = f"A: {_title(first)}", f"B: {_title(second)}"
    if options[0] != options[1]:
        pair = zip(names, (first, second), options, strict=True)
        names = tuple(
            f"{name}, {option}" if "option" in of.coords else name for name, of, option in pair
        )
    return {
        **software_attributes(f"compare {names[0]} with {names[1]}"),
        "title": f"Orders of {names[1]} against {names[0]}",
        "first": names[0],
        "second": names[1],
        "first_angle_zero": _angle_zero(first),
        "second_angle_zero": _angle_zero(second),
        "option": options[0],
        "other_option": options[1],
        "tacho_angle_rad": tacho_angle_rad,
    }
