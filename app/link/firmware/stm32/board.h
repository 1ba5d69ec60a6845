/* The machine's inputs and outputs on the pins of the board. */
#ifndef BOARD_H
#define BOARD_H

#include "machine.h"

void board_start(void);
void board_read(dl_inputs *in);
void board_write(const dl_outputs *out);
/* Whatever has gone wrong: motors and laser without power, at once. */
void board_off(void);

#endif
