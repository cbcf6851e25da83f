"""The part of the page that moves: levels, spectrum and sound under sliders, without a server."""
