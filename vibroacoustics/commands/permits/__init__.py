"""Page of `permit` and its file to begin with."""
