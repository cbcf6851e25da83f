"""What measurements alone predict: levels after a change of mounts, masses or absorbers."""
