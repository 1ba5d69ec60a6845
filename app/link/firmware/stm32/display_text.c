#include "display_text.h"

enum { NUMBER_WIDTH = 6, THETA = 0xF2 /* in the display's own alphabet */ };

static const uint8_t axes[DISPLAY_ROWS] = {'X', 'Y', 'Z', THETA};

void display_row(char text[DISPLAY_COLUMNS], uint8_t row, float q, float measured, float coordinate)
{
    text[0] = (char)('1' + row);
    write_tenths(text + 1, NUMBER_WIDTH, q);
    write_tenths(text + 1 + NUMBER_WIDTH, NUMBER_WIDTH, measured);
    text[1 + 2 * NUMBER_WIDTH] = (char)axes[row];
    write_tenths(text + 2 + 2 * NUMBER_WIDTH, NUMBER_WIDTH, coordinate);
}

static void write_dashes(char *text, uint8_t width)
{
    for (uint8_t i = 0; i < width; i++) text[i] = i < width - 3 ? ' ' : '-';
}

void write_tenths(char *text, uint8_t width, float value)
{
    const float magnitude = value < 0.0f ? -value : value;
    if (!(magnitude < 99999.0f)) return write_dashes(text, width);
    uint32_t tenths = (uint32_t)(10.0f * magnitude + 0.5f);
    const uint8_t negative = value < 0.0f && tenths > 0;
    uint8_t at = width;
    for (uint8_t digits = 0; at && (digits < 2 || tenths); digits++, tenths /= 10) {
        if (digits == 1) text[--at] = '.';
        if (at) text[--at] = (char)('0' + tenths % 10);
    }
    if (tenths || (negative && !at)) return write_dashes(text, width);
    if (negative) text[--at] = '-';
    while (at) text[--at] = ' ';
}
