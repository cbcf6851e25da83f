"""Hermetic reciprocating compressor (Estupiñan & Santos): oil films, beam rotor, steady cycle."""

from .machine import HermeticCompressor

__all__ = ["HermeticCompressor"]
