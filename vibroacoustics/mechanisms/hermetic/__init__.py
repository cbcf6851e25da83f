"""Hermetic reciprocating compressor (Estupiñan & Santos): oil films, beam rotor, steady cycle."""
