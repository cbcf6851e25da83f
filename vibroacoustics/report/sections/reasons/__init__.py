"""Section of the report: reasons for the summary."""
