"""The page of a comparison: two results side by side, recordings against a study, limits."""
