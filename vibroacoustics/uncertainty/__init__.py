"""What is not known: ranges, and draws of values from them."""
