"""What is not known: ranges, and samples of values from them."""
