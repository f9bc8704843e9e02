"""What pushes: gas in the cylinder, calculated or measured."""
