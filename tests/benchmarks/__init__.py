"""Measurements, run by hand: `python tests/benchmarks/load.py`. The tests make no claim about time."""
