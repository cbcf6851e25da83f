"""Elastic modes of the compressor's closed shell: frequencies, surface motion, what drives them."""
