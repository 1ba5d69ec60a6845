"""Recordings of a real robot, its simulated twin beside them, and its motors and gains for the control lab."""
