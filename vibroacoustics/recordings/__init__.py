"""Recordings in: WAV, MAT, CSV, HDF5, netCDF, UFF 58 and TDMS as one labelled form; modes and
functions of frequency in.

The functions are imported when they are first asked for: the process that reads a file (`child`)
needs no labelled arrays.
"""

from ..base.lazy import public_names

__getattr__, __dir__, __all__ = public_names(__name__, __file__)
