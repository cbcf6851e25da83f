"""Published mechanism models, one folder a kind of machine."""
