"""Who drives the machine from within: gas, keys, motor."""
