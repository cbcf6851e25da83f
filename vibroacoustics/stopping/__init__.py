"""Stopping (thesis 6.4): the shaft runs down while the orbiting set turns out of balance."""
