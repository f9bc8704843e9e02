"""The worked calculation note: one document, written as PDF, Word and web page."""
