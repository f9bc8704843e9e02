"""A machine made ready for its analysis: stated inputs, motion and gas, and the engine that a linkage is."""
