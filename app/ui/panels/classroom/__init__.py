"""Panels of the instructor's page."""
