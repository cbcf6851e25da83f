"""Tables of a machine file: what every machine has, and what options and sources do to it."""
