"""The machine file: its keys, its reader, its templates."""
