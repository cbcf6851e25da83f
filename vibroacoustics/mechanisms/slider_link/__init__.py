"""Slider-link compressor (Dagilis et al.): contact forces, friction, crank motion, unbalance."""
