#include "emulator.h"

__attribute__((section(".noinit"))) volatile emulator_block sim;

void emulator_read(dl_inputs *in)
{
    for (uint8_t j = 0; j < DL_JOINTS; j++) in->raw[j] = sim.raw[j];
    in->limit_switches = (uint8_t)sim.limit_switches;
    in->estop_open = (uint8_t)sim.estop_open;
}

void emulator_write(const dl_outputs *out)
{
    for (uint8_t j = 0; j < DL_JOINTS; j++) sim.drive[j] = out->drive[j];
    sim.powered = out->powered;
    sim.pen_us = out->pen_us;
    sim.laser = out->laser;
    sim.ticks++;
}
