"""A traced calculation compiled for many designs."""
