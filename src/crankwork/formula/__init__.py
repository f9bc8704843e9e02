"""A formula computes, is traced, prints and differentiates."""
