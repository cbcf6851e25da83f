"""Orders of one result against those of another: simulated, recorded, or one of each."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .errors import ParameterError
from .schema import REFERENCE_OPTION, check, label_coordinates, stamp

SPEED_TOLERANCE: Final = 0.02
"""Speeds of the two results that differ by less than this share are the same operating point."""
_ORDER_TOLERANCE: Final = 1e-6
_TINY: Final = np.finfo(float).tiny


def compare(
    first: xr.Dataset,
    second: xr.Dataset,
    pairs: Mapping[str, str] | None = None,
    option: str = REFERENCE_OPTION,
    tacho_angle_rad: float = 0.0,
) -> xr.Dataset:
    """Order by order, in level and phase, at the speeds that both results have.

    Parameters
    ----------
    first, second : results of `run` or of `analyse_orders`
    pairs : channel of the second for each channel of the first; without it, those of one name
    option : the balancing option of a study that is compared
    tacho_angle_rad : crank angle of the first result at which the second's tacho gives its pulse

    Returns
    -------
    `channel_order` of the first, `compared_order` of the second turned to the first's crank angle,
    `order_difference` (dB) and `order_phase_difference` (rad, within ±π), each (channel, speed,
    order); coordinate `compared_speed`

    Raises
    ------
    ParameterError
        The results have no channel, unit, order or speed in common.
    """
    ours, theirs = (channel_orders(result, option) for result in (first, second))
    names = _pairs(ours, theirs, pairs)
    order = _common_orders(ours, theirs)
    speeds = _common_speeds(ours, theirs)
    reference = _selected(ours, list(names), speeds[:, 0], order)
    other = _selected(theirs, list(names.values()), speeds[:, 1], order)
    turned = other * np.exp(-1j * order * tacho_angle_rad)
    size, other_size = np.maximum(np.abs(reference), _TINY), np.maximum(np.abs(turned), _TINY)
    coords = {"channel": list(names), "speed": speeds[:, 0], "order": order}
    values = {
        "channel_order": reference,
        "compared_order": turned,
        "order_difference": 20.0 * np.log10(other_size / size),
        "order_phase_difference": np.angle(turned * np.conj(reference)),
    }
    compared = xr.Dataset(
        {name: stamp(name, value, coords) for name, value in values.items()},
        coords={
            "compared_speed": ("speed", speeds[:, 1]),
            "channel_unit": ours["channel_unit"].sel(channel=list(names)),
            "compared_channel": ("channel", list(names.values())),
        },
    )
    return check(label_coordinates(compared))


def channel_orders(result: xr.Dataset, option: str = REFERENCE_OPTION) -> xr.DataArray:
    """Complex peaks (channel, speed, order) of a result with `channel_unit`.

    A study's channels are named by what they are and where: `pressure NAME`, `force x`,
    `moment x`, `foot force NAME x`, `velocity tx`, `acceleration tx`.

    Raises
    ------
    ParameterError
        The result holds no orders, or not that option.
    """
    if "channel_order" in result:
        return result["channel_order"]
    if "force_order" not in result:
        raise ParameterError(f"{result.attrs.get('title', 'result')}: holds no orders")
    options = [str(name) for name in result["option"].values]
    if option not in options:
        raise ParameterError(f"option {option!r}: is none of {', '.join(options)}")
    chosen = result.sel(option=option)
    parts = [
        _named(chosen[variable].sum("source"), f"{word} {{}}", unit)
        for variable, word, unit in _SIMULATED
    ]
    velocity = chosen["velocity_order"].sum("source")
    translations = velocity.sel(dof=[name for name in velocity["dof"].values if name[0] == "t"])
    parts.append(_named(translations, "velocity {}", "m/s"))
    pulsation = 2j * np.pi * result["order_frequency"]
    parts.append(_named(translations * pulsation, "acceleration {}", "m/s²"))
    return xr.concat(parts, "channel")


_SIMULATED: Final = (
    ("pressure_order", "pressure", "Pa"),
    ("force_order", "force", "N"),
    ("moment_order", "moment", "N m"),
    ("foot_force_order", "foot force", "N"),
)


def _named(values: xr.DataArray, name: str, unit: str) -> xr.DataArray:
    """Values (speed, ..., order) as channels (channel, speed, order)."""
    places = [dim for dim in values.dims if dim not in ("speed", "order")]
    flat = values.stack(place=places).transpose("place", "speed", "order")
    labels = [
        " ".join(map(str, np.atleast_1d(np.array(place, dtype=object))))
        for place in flat["place"].values
    ]
    channels = [name.format(label) for label in labels]
    return xr.DataArray(
        flat.values,
        dims=("channel", "speed", "order"),
        coords={
            "channel": channels,
            "speed": values["speed"].values,
            "order": values["order"].values,
            "channel_unit": ("channel", [unit] * len(channels)),
        },
        name="channel_order",
    )


def _pairs(
    ours: xr.DataArray, theirs: xr.DataArray, pairs: Mapping[str, str] | None
) -> dict[str, str]:
    """Channel of the second by that of the first, both there and of one unit."""
    units, other_units = (_units(result) for result in (ours, theirs))
    chosen = dict(pairs) if pairs else {name: name for name in units if name in other_units}
    if not chosen:
        raise ParameterError(
            f"no channel has the same name in both: {_listed(units)} against "
            f"{_listed(other_units)}; pair them"
        )
    for name, other in chosen.items():
        for wanted, there in ((name, units), (other, other_units)):
            if wanted not in there:
                raise ParameterError(
                    f"pair {name}={other}: no channel {wanted!r}; there are {_listed(there)}"
                )
        if units[name] != other_units[other]:
            raise ParameterError(
                f"pair {name}={other}: units differ, {units[name]} and {other_units[other]}"
            )
    return chosen


def _units(result: xr.DataArray) -> dict[str, str]:
    return dict(
        zip(
            map(str, result["channel"].values),
            map(str, result["channel_unit"].values),
            strict=True,
        )
    )


def _listed(units: Mapping[str, str]) -> str:
    return ", ".join(f"{name} [{unit}]" for name, unit in units.items())


def _common_orders(ours: xr.DataArray, theirs: xr.DataArray) -> NDArray[np.float64]:
    """Orders that both have, without order 0."""
    order, other = (np.asarray(result["order"].values, dtype=float) for result in (ours, theirs))
    there = np.abs(order[:, None] - other).min(axis=1) < _ORDER_TOLERANCE
    common: NDArray[np.float64] = order[there & (order > 0.0)]
    if not common.size:
        raise ParameterError(
            f"no order in common: {', '.join(map('{:g}'.format, order))} against "
            f"{', '.join(map('{:g}'.format, other))}"
        )
    return common


def _common_speeds(ours: xr.DataArray, theirs: xr.DataArray) -> NDArray[np.float64]:
    """Pairs of speeds (pair, 2) that differ by less than the tolerance, each used once."""
    speed, other = (np.asarray(result["speed"].values, dtype=float) for result in (ours, theirs))
    nearest = other[np.abs(speed[:, None] - other).argmin(axis=1)]
    near = np.abs(nearest - speed) <= SPEED_TOLERANCE * speed
    found: NDArray[np.float64] = np.stack([speed, nearest], axis=1)[near]
    if not found.size:
        raise ParameterError(
            f"no speed in common within {100 * SPEED_TOLERANCE:g} %: "
            f"{', '.join(map('{:.0f}'.format, speed))} against "
            f"{', '.join(map('{:.0f}'.format, other))} rpm"
        )
    return found


def _selected(
    result: xr.DataArray, names: list[str], speeds: NDArray[Any], order: NDArray[np.float64]
) -> NDArray[np.complex128]:
    chosen = result.sel(channel=names, speed=speeds).sel(
        order=order, method="nearest", tolerance=_ORDER_TOLERANCE
    )
    return np.asarray(chosen.transpose("channel", "speed", "order").values, dtype=complex)
