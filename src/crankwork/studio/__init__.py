"""The studio: a local page to view a machine and to change its file."""
