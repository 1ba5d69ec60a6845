"""The control lab: settings, experiments and runs of one browser."""
