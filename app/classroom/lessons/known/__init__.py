"""What lessons may read, set and press, one file a field. Plain data: nothing is imported for it."""
