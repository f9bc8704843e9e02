"""How a mechanism moves."""
