"""The charts of the report, each with one idea, as data."""
