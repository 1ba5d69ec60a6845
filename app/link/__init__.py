"""The physical robot: the serial protocol, boards real and emulated, firmware, and who may move it."""
