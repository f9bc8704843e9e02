"""What a mechanism is."""
