"""Section of the report: tones and loudness."""
