"""From designs to what is seen of them: by linear algebra where that is exact, else run by run."""
