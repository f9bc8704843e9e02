"""Masses, and the forces that follow from motion and loads."""
