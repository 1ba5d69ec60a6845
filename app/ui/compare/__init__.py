"""Controllers compared: settings, simulated runs, scores and pictures of one browser."""
