"""Order spectra of a study's forces, labelled."""

import numpy as np
import xarray as xr

from ..base.ellipse import semi_major_axis
from ..base.units import shaft_frequency_hz
from ..base.vocabulary import check, stamp
from ..study.study import Study
from .spectrum import order_spectra


def order_variables(study: Study, results: xr.Dataset) -> xr.Dataset:
    """Order spectra of force and moment, and the ellipses of their resultants.

    The slowest speed of the study has the most orders. Beyond the highest one of a speed there is
    silence: force, moment and all that follows of them are zero.
    """
    speeds = results["speed"].values
    order = np.arange(study.highest_order(min(study.operation.speed_rpm)) + 1)
    held = order <= np.array([[study.highest_order(speed)] for speed in speeds])
    coords = {name: results[name] for name in ("speed", "option", "source", "axis")}
    spectra = {}
    for name in ("force", "moment"):
        spectrum = order_spectra(results[name].values, results["shaft_speed"].values, order[-1])
        spectrum = np.where(held[:, None, None, None], spectrum, 0.0)
        spectra[f"{name}_order"] = stamp(f"{name}_order", spectrum, {**coords, "order": order})
        resultant = semi_major_axis(spectrum.sum(axis=2), axis=2)
        spectra[f"{name}_amplitude"] = stamp(
            f"{name}_amplitude",
            resultant,
            {"speed": coords["speed"], "option": coords["option"], "order": order},
        )
    frequency = shaft_frequency_hz(1.0) * speeds[:, None] * order
    return check(xr.Dataset(spectra, coords={"order_frequency": (("speed", "order"), frequency)}))
