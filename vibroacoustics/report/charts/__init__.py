"""Figures as data, drawn for page and paper as SVG and for notebooks by matplotlib."""
