"""Loads of a mechanism: gas in the cylinder, calculated or measured, springs, dampers, weights and processes."""
