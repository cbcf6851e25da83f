"""Order analysis: spectra over crank angle and the ellipses of vector orders.

>>> motion = va.orders.constant_speed(50.0, 0.0, 2.0)  # Hz, from and to in s
>>> time = np.arange(2048) / 1024.0
>>> angular = va.orders.angular_resample(np.cos(motion.angle_rad(time)), 1024.0, motion, 4.0)
>>> spectra = va.orders.order_map(angular, 0.25, "hann")
>>> va.orders.order_cut(spectra, [1.0]).rms[0].round(3)
array([0.707])
"""

from ..base.ellipse import semi_major_axis
from .angular import AngularSignal, whole_revolutions
from .angular_stream import angular_resample
from .block_maps import order_map_of_blocks
from .crank_motion import CrankMotion, constant_speed, from_angle, from_speed
from .frequency_map import FrequencyMap, frequency_map
from .order_cut import OrderCut, OrderResolutionWarning, order_cut, order_lines
from .order_map import OrderMap, block_phasors, mean_order_spectrum, order_map
from .pulse_edges import pulse_times
from .pulse_faults import PulseFault
from .rpm_channel import rpm_motion
from .spectrum import order_spectra, order_spectrum, order_spectrum_at_speed
from .synchronous import OrderEnvelope, synchronous_demodulation
from .synchronous_average import SynchronousAverage, time_synchronous_average
from .tacho import TachoResult, tacho_motion
from .tacholess import TacholessResult, tacholess_motion
from .vold_kalman import Track, TrackedOrders, vold_kalman

__all__ = [
    "AngularSignal",
    "CrankMotion",
    "FrequencyMap",
    "OrderCut",
    "OrderEnvelope",
    "OrderMap",
    "OrderResolutionWarning",
    "PulseFault",
    "SynchronousAverage",
    "TachoResult",
    "TacholessResult",
    "Track",
    "TrackedOrders",
    "angular_resample",
    "block_phasors",
    "constant_speed",
    "frequency_map",
    "from_angle",
    "from_speed",
    "mean_order_spectrum",
    "order_cut",
    "order_lines",
    "order_map",
    "order_map_of_blocks",
    "order_spectra",
    "order_spectrum",
    "order_spectrum_at_speed",
    "pulse_times",
    "rpm_motion",
    "semi_major_axis",
    "synchronous_demodulation",
    "tacho_motion",
    "tacholess_motion",
    "time_synchronous_average",
    "vold_kalman",
    "whole_revolutions",
]
