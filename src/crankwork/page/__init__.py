"""A machine as one web page: moving, its diagrams to read, its values explained."""
