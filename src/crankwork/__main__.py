"""`python -m crankwork`."""

from crankwork.cli import main

main()
