"""Section of the report: dominant sources."""
