"""Studies of a machine file with one number replaced: where a value is what is wanted."""
