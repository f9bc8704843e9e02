"""The working cycle: from fuel, mixture and losses to the indicator diagram, every value with its formula."""
