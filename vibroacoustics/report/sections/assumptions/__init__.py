"""Section of the report: assumptions, inputs and errata."""
