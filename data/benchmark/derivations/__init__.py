"""Where the expected values of the benchmark come from; no package is needed."""
