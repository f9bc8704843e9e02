"""A formula computes, remembers, prints and differentiates."""
