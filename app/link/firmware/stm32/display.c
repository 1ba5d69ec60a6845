#include "display.h"

/* The data sheet's way into the 4-bit mode; then 4-bit, two lines (of 40), no cursor, from left to right, clear. */
static const struct {
    uint8_t half, pause_ms;
} initialisation[] = {
    {0x3, 5}, {0x3, 1}, {0x3, 1}, {0x2, 1}, {0x2, 0}, {0x8, 1},
    {0x0, 0}, {0xC, 1}, {0x0, 0}, {0x6, 1}, {0x0, 0}, {0x1, 3},
};
enum { INITIALISATION = sizeof initialisation / sizeof initialisation[0], POWER_UP_MS = 50 };
enum { ROW_HALVES = 2 * (1 + DISPLAY_COLUMNS), PICTURE = DISPLAY_ROWS * ROW_HALVES, GO_TO = 0x80 };

static const uint8_t row_address[DISPLAY_ROWS] = {0x00, 0x40, 0x14, 0x54};

static uint8_t initialise(display *d)
{
    d->pause_ms = initialisation[d->at].pause_ms;
    return initialisation[d->at++].half;
}

/* Row by row: where it begins, then its characters; of each byte the upper half first. */
static uint8_t draw(display *d, display_source *source)
{
    const uint16_t i = (uint16_t)(d->at - INITIALISATION);
    const uint8_t row = (uint8_t)(i / ROW_HALVES), byte = (uint8_t)(i % ROW_HALVES / 2);
    if (i % ROW_HALVES == 0) source(row, d->text);
    const uint8_t value = byte ? (uint8_t)d->text[byte - 1] : GO_TO | row_address[row];
    const uint8_t half = i % 2 ? value & DISPLAY_DATA : value >> 4;
    d->at = (uint16_t)(INITIALISATION + (i + 1) % PICTURE);
    return half | (byte ? DISPLAY_RS : 0);
}

uint8_t display_step(display *d, display_source *source)
{
    if (d->waited_ms < POWER_UP_MS) {
        d->waited_ms++;
    } else if (d->wires & DISPLAY_E) {
        d->wires &= (uint8_t)~DISPLAY_E; /* this edge makes it read the others */
    } else if (d->pause_ms) {
        d->pause_ms--;
    } else {
        d->wires = DISPLAY_E | (d->at < INITIALISATION ? initialise(d) : draw(d, source));
    }
    return d->wires;
}
