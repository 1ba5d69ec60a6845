/* What QEMU does not have (converter, PWM, pins, flash to write to, a chip's number) is this block of memory there.
 *
 * A test's harness finds it by its symbol `sim`, puts in where the joints are, and reads what the motors get. On a
 * real board nobody touches it. It outlives a reset, as sensors and flash do.
 */
#ifndef EMULATOR_H
#define EMULATOR_H

#include <stdint.h>

#include "machine.h"

enum { STORE_WORDS = 1 + (DL_IMAGE_BYTES + 3) / 4 };

typedef struct {
    uint32_t ticks; /* control periods made: the plant's clock */
    uint32_t powered;
    float drive[DL_JOINTS], pen_us, laser;
    float raw[DL_JOINTS];
    uint32_t limit_switches, estop_open, reset, chip_id[3];
    uint32_t store[STORE_WORDS];
} emulator_block;

extern volatile emulator_block sim;

void emulator_read(dl_inputs *in);
void emulator_write(const dl_outputs *out);

#endif
