"""Sources within the machine: gas, keys, motor."""
