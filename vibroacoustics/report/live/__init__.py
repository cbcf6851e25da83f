"""Scripts and style of the part of the page that moves."""
