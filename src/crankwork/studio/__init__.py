"""The studio: a local page over the calculation as it is, for looking and trying."""
