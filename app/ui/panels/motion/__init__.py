"""Panels of the tab Motion."""
