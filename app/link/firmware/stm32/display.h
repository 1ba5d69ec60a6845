/* A text display of the HD44780 kind, 20 x 4, written in halves of bytes and never waited for.
 *
 * Its slowest step takes 2 ms, others 40 us: one step a millisecond needs no look at its busy flag, and all 80
 * characters are new three times a second.
 */
#ifndef DISPLAY_H
#define DISPLAY_H

#include <stdint.h>

#include "display_text.h"

enum { DISPLAY_DATA = 0x0F, DISPLAY_RS = 0x10, DISPLAY_E = 0x20 };

/* All 0 in the beginning. */
typedef struct {
    uint16_t at; /* which half of a byte comes next: first the initialisation, then the picture again and again */
    uint8_t waited_ms, pause_ms, wires;
    char text[DISPLAY_COLUMNS];
} display;

/* Writes the text of one row. */
typedef void display_source(uint8_t row, char text[DISPLAY_COLUMNS]);

/* To be called once a millisecond: the level of the wires from now on, DISPLAY_... bits. */
uint8_t display_step(display *d, display_source *source);

#endif
