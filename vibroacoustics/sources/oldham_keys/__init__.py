"""Oldham ring whose keys have clearance in their slots: contact, rattle, key forces."""
