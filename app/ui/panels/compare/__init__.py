"""The panels that compare controllers."""
