"""Drawing of the machine that opens the report: outline, feet, microphones, forces; plain SVG."""
