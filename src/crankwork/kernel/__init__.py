"""A remembered calculation compiled for many designs."""
