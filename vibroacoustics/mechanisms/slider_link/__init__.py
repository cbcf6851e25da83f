"""Slider-link compressor (Dagilis et al.): contact forces, friction, crank motion, unbalance."""

from .machine import SliderLinkMachine

__all__ = ["SliderLinkMachine"]
