"""One drawing: scenes in millimetres, charts on them, and writers for each format."""
