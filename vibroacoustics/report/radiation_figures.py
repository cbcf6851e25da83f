"""The figures of the sound field alone, without machine and options."""

import xarray as xr

from .figures.directivity import directivity_figure
from .figures.maps import map_figure
from .figures.style import Picture
from .figures.transfer_vectors import transfer_vector_figure


def radiation_figures(radiated: xr.Dataset) -> list[Picture]:
    """The figures that the dataset has variables for."""
    makers = {
        "transfer_vector": transfer_vector_figure,
        "map_transfer_vector": map_figure,
        "directivity_transfer_vector": directivity_figure,
    }
    return [make(radiated) for name, make in makers.items() if name in radiated]
