"""Studies of a machine file whose numbers vary: solve, spread, sweep, map, optimise."""
