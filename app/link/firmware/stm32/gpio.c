#include "gpio.h"

enum { MODE_INPUT, MODE_OUTPUT, MODE_ALTERNATE, MODE_ANALOG };

/* Two bits of a register belong to each pin. */
static void set_pair(reg *where, uint8_t pin, uint32_t value)
{
    const uint8_t shift = 2 * (pin % 16);
    *where = (*where & ~(3u << shift)) | value << shift;
}

static void set_mode(uint8_t pin, uint32_t mode) { set_pair(&GPIO(pin / 16)->MODER, pin, mode); }

void pin_output(uint8_t pin) { set_mode(pin, MODE_OUTPUT); }

void pin_analog(uint8_t pin) { set_mode(pin, MODE_ANALOG); }

void pin_pullup(uint8_t pin) { set_pair(&GPIO(pin / 16)->PUPDR, pin, 1); }

void pin_input_pullup(uint8_t pin)
{
    pin_pullup(pin);
    set_mode(pin, MODE_INPUT);
}

void pin_alternate(uint8_t pin, uint8_t function)
{
    reg *where = &GPIO(pin / 16)->AFR[pin % 16 / 8];
    const uint8_t shift = 4 * (pin % 8);
    *where = (*where & ~(15u << shift)) | (uint32_t)function << shift;
    set_mode(pin, MODE_ALTERNATE);
}
