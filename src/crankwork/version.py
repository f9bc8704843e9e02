"""The version of the program, said here alone."""

__version__ = "0.2.0"
