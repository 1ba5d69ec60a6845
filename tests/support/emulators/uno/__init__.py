"""The Arduino Uno's firmware in simavr: a test tool, for simavr is under the GPL."""
