/* An output that interrupts set in two instructions; digitalWrite takes 4 us. */
#ifndef DL_FAST_PIN_H
#define DL_FAST_PIN_H

#include <Arduino.h>

typedef struct {
    volatile uint8_t *port;
    uint8_t mask;
} fast_pin;

static fast_pin begin_fast_pin(uint8_t pin) {
    pinMode(pin, OUTPUT);
    fast_pin fast = {portOutputRegister(digitalPinToPort(pin)), digitalPinToBitMask(pin)};
    return fast;
}

/* In interrupts only: reading and writing the port must stay together. */
static inline void raise_pin(fast_pin pin) { *pin.port |= pin.mask; }
static inline void lower_pin(fast_pin pin) { *pin.port &= ~pin.mask; }

#endif
