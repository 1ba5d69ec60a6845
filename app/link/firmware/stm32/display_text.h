/* What the text display shows: of each joint the set-point q, the measured Q, and beside them X, Y, Z and theta. */
#ifndef DISPLAY_TEXT_H
#define DISPLAY_TEXT_H

#include <stdint.h>

enum { DISPLAY_COLUMNS = 20, DISPLAY_ROWS = 4 };

/* `1 -23.0 -22.9X 100.0`: joint, q, Q, and the pose's coordinate of this row. In degrees and millimetres. */
void display_row(char text[DISPLAY_COLUMNS], uint8_t row, float q, float measured, float coordinate);
/* Right-aligned with one decimal; dashes for what has no value or no room. */
void write_tenths(char *text, uint8_t width, float value);

#endif
