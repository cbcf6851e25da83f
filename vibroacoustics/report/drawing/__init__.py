"""Drawing of the machine that opens the report: outline, feet, microphones, forces; plain SVG."""

from .picture import machine_picture, section_picture

__all__ = ["machine_picture", "section_picture"]
