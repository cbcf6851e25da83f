"""Rules of countries and procedures; one file each."""
