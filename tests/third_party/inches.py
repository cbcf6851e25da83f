"""A third party's unit of length."""

import vibroacoustics

INCH = vibroacoustics.Unit("inch", "in", "m", 0.0254)
vibroacoustics.register(INCH)
