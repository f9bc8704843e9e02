"""Showing results: tables, figures, the moving drawing, languages."""
