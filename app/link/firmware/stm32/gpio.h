/* Pins, named as in pins.h. */
#ifndef GPIO_H
#define GPIO_H

#include <stdint.h>

#include "pins.h"
#include "stm32f4.h"

/* Many pins of a port at once, and nothing in between is seen. */
static inline void port_write(uint8_t port, uint16_t high, uint16_t low)
{
    GPIO(port)->BSRR = high | (uint32_t)low << 16;
    host_reacts();
}

static inline void pin_write(uint8_t pin, uint8_t high)
{
    const uint16_t bit = (uint16_t)(1u << pin % 16);
    port_write(pin / 16, high ? bit : 0, high ? 0 : bit);
}

static inline uint8_t pin_read(uint8_t pin) { return GPIO(pin / 16)->IDR >> pin % 16 & 1; }

void pin_output(uint8_t pin);
void pin_input_pullup(uint8_t pin);
void pin_analog(uint8_t pin);
void pin_alternate(uint8_t pin, uint8_t function);
void pin_pullup(uint8_t pin);

#endif
