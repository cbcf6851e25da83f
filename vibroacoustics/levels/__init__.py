"""Levels: weightings, sums, bands, filter bank, time weighting, levels of recordings.

>>> time = np.arange(8000) / 8000.0
>>> pascal = np.sqrt(2.0) * np.sin(2.0 * np.pi * 1000.0 * time)
>>> va.levels.recorded_levels(pascal, 8000.0, 20e-6, "A").equivalent_db.round(1).item()
94.0
"""

from ..base.lazy import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
