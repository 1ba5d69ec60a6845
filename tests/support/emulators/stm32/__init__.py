"""The STM32F407 in QEMU, and its drivers on a desktop."""
