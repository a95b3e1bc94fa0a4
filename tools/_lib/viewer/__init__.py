"""The window of tools/view."""
