"""Panels of the tab Draw."""
