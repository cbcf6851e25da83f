"""Large reciprocating compressor (Tsuji et al.): slider-crank with Coulomb friction."""

from .machine import ReciprocatingMachine

__all__ = ["ReciprocatingMachine"]
