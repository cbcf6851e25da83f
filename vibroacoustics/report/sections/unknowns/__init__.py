"""Section of the report: uncertain parameters."""
