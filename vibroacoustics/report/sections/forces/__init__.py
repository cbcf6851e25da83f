"""Section of the report: forces over a revolution."""
