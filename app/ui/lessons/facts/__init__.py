"""Where a lesson's facts come from, one file a field: how each is read off the desks, and how it is set there."""
