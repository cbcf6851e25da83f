"""Options of balancing and quieting, one file each: parameters, physics and words."""
