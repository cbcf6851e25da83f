"""Order analysis: spectra over crank angle and the ellipses of vector orders."""

from .angular import AngularSignal, angular_resample, whole_revolutions
from .ellipse import semi_major_axis
from .order_cut import OrderCut, OrderResolutionWarning, order_cut, order_lines
from .order_map import FrequencyMap, OrderMap, frequency_map, mean_order_spectrum, order_map
from .spectrum import FFT_ENGINE, order_spectrum
from .synchronous import (
    OrderEnvelope,
    SynchronousAverage,
    synchronous_demodulation,
    time_synchronous_average,
)

__all__ = [
    "FFT_ENGINE",
    "AngularSignal",
    "FrequencyMap",
    "OrderCut",
    "OrderEnvelope",
    "OrderMap",
    "OrderResolutionWarning",
    "SynchronousAverage",
    "angular_resample",
    "frequency_map",
    "mean_order_spectrum",
    "order_cut",
    "order_lines",
    "order_map",
    "order_spectrum",
    "semi_major_axis",
    "synchronous_demodulation",
    "time_synchronous_average",
    "whole_revolutions",
]
