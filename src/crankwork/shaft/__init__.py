"""The machine as one turning mass: how its speed fluctuates, its flywheel, its motor, its start and its stop."""
