"""Moving parts, rotation, shafts: what machines, sources and balancers share."""
