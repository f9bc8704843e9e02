"""The words of the notes in each language."""
