"""Results made up: changes of levels and forces, statistics of what is held by sample."""

import json

import numpy as np
import xarray as xr

from vibroacoustics.base.units import shaft_frequency_hz
from vibroacoustics.base.vocabulary import VARIABLES, WEIGHTINGS, stamp
from vibroacoustics.levels.changes import AMPLITUDES, FORCES, JUDGED, change_variables, changes_of
from vibroacoustics.levels.labelled import level_changes
from vibroacoustics.results.estimates import estimated
from vibroacoustics.study.scoring import Measurable
from vibroacoustics.uncertainty.sample_variables import Weighted

PLACE = ("speed", "option", "receiver")
LEAST = 1e-30
"""Of energies, so that each has a level."""


def judged(results: xr.Dataset) -> xr.Dataset:
    """Results with changes and judgements of the nominal levels and forces that they hold."""
    place = {name: results[name].values for name in PLACE}
    levels = {
        "level_total": results["level_total"].transpose(*PLACE).values,
        "level_modelled": results["level_modelled"].transpose(*PLACE, "weighting").values,
        "order_level": results["order_level"].transpose(*PLACE, "order", "weighting").values,
    }
    changes = level_changes(levels, results["option"].values.tolist().index("none"))
    coords = {**place, "order": results["order"].values}
    made = {
        name: stamp(name, values, {dim: coords[dim] for dim in VARIABLES[name].dims})
        for name, values in changes.items()
    }
    foot = results["foot_force_amplitude"].max("foot").transpose("speed", "option", "order")
    coords = {name: results[name].values for name in foot.dims}
    made["largest_foot_force"] = stamp("largest_foot_force", foot.values, coords)
    forces = results.assign(made).assign_coords(order_frequency=_order_frequency(results))
    modelled = levels["level_modelled"][..., WEIGHTINGS.index("A")]
    rest = np.maximum(10.0 ** (levels["level_total"] / 10.0) - 10.0 ** (modelled / 10.0), LEAST)
    made["residual_level"] = stamp("residual_level", 10.0 * np.log10(rest), place)
    made |= _shares(results, place)
    return results.assign(made).assign(change_variables(_least(results), forces, forces))


def _shares(results: xr.Dataset, place: dict[str, np.ndarray]) -> dict[str, xr.DataArray]:
    """Shares of the energy of sources whose lines do not interfere."""
    by_source = {**place, "sound_source": results["sound_source"].values}
    share = 10.0 ** ((results["source_level"] - results["level_total"]) / 10.0)
    share = share.transpose("speed", "option", "sound_source", "receiver").values
    by_source = {name: by_source[name] for name in ("speed", "option", "sound_source", "receiver")}
    return {
        "source_share": stamp("source_share", share, by_source),
        "unmodelled_share": stamp("unmodelled_share", 1.0 - share.sum(axis=2), place),
    }


def restated(results: xr.Dataset) -> xr.Dataset:
    """Results with the statistics of the levels, shares and forces that they hold by sample."""
    results = _nominal(results)
    weight = Weighted(results["sample_weight"].values[0])
    total = _by_sample(results, "level_total", *PLACE)
    modelled = _by_sample(results, "level_modelled", *PLACE)
    source = _by_sample(results, "source_level", "speed", "option", "sound_source", "receiver")
    share = 10.0 ** ((source - total[:, :, :, None]) / 10.0)
    rest = 1.0 - share.sum(axis=3)
    order = np.repeat(_nominal_of(results, "order_level", *PLACE, "order", "weighting"),
                      len(total), axis=0)  # fmt: skip
    weighted = np.repeat(_nominal_of(results, "level_modelled", *PLACE, "weighting"),
                         len(total), axis=0)  # fmt: skip
    weighted[..., WEIGHTINGS.index("A")] = modelled
    levels = {"level_total": total, "level_modelled": weighted, "order_level": order}
    reference = results["option"].values.tolist().index("none")
    levels |= level_changes(levels, reference) | {
        "source_level": source,
        "source_share": share,
        "unmodelled_share": rest,
        "residual_level": total + 10.0 * np.log10(np.maximum(rest, LEAST)),
        "level_unmodelled": _by_sample(results, "level_unmodelled"),
    }
    by_name = zip(AMPLITUDES, _OF_FORCE, strict=True)
    forces = {name: _forces(results, *names) for name, names in by_name}
    first = np.array([values[..., 1] for values in forces.values()])
    hertz = _order_frequency(results).values[:, 1]
    changes = changes_of(
        first, total, order[..., 1, WEIGHTINGS.index("Z")], hertz, reference, _least(results)
    )
    levels |= forces | {
        f"{name}_change_1x": one for name, one in zip(FORCES, changes.force_db, strict=True)
    }
    coords = {str(name): array.values for name, array in results.coords.items()}
    parts = [weight.statistics(name, values, coords) for name, values in levels.items()]
    at = {**{name: results[name].values for name in PLACE}, "judged_quantity": list(JUDGED)}
    at = {name: at[name] for name in ("judged_quantity", *PLACE)}
    chances = xr.Dataset(
        {
            f"{name}_probability": stamp(
                f"{name}_probability", np.tensordot(weight.weight, values, axes=1), at
            )
            for name, values in (("increase", changes.increased), ("decrease", changes.decreased))
        }
    )
    of_samples = xr.merge([*parts, chances])
    return estimated(results, of_samples).assign_attrs(results.attrs)


_OF_FORCE = (("force_amplitude", "force"), ("moment_amplitude", "moment"),
             ("largest_foot_force", "foot_force"))  # fmt: skip


def _nominal(results: xr.Dataset) -> xr.Dataset:
    """Results with their nominal values in place of statistics."""
    own = {str(name).removesuffix("_nominal"): values for name, values in results.items()
           if str(name).endswith("_nominal")}  # fmt: skip
    others = [name for name in results.data_vars
              if str(name).endswith(("_nominal", "_10_percent", "_90_percent"))]  # fmt: skip
    return results.drop_vars(others).assign(own)


def _by_sample(results: xr.Dataset, name: str, *dims: str) -> np.ndarray:
    return results[f"{name}_by_sample"].transpose("sample", *dims).values


def _nominal_of(results: xr.Dataset, name: str, *dims: str) -> np.ndarray:
    return results[name].transpose(*dims).values[None].copy()


def _forces(results: xr.Dataset, name: str, of_first: str) -> np.ndarray:
    """Amplitudes by sample, shape (sample, speed, option, order): nominal but for those at 1x."""
    values = _nominal_of(results, name, "speed", "option", "order")
    values = np.repeat(values, results.sizes["sample"], axis=0)
    if f"{of_first}_1x_by_sample" in results:
        values[..., 1] = _by_sample(results, f"{of_first}_1x", "speed", "option")
    return values


def _order_frequency(results: xr.Dataset) -> xr.DataArray:
    orders = results["order"].values
    hertz = shaft_frequency_hz(results["speed"].values)[:, None] * orders
    return xr.DataArray(hertz, dims=("speed", "order"))


def _least(results: xr.Dataset) -> Measurable:
    scoring = json.loads(results.attrs["parameters"])["scoring"]
    return Measurable(**scoring.get("measurable", {}))
