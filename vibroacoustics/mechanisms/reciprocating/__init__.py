"""Large reciprocating compressor (Tsuji et al.): slider-crank with Coulomb friction."""
