"""The panels of the tab Hardware."""
