/* Pulses for RC servos, one after the other, from TIMER1's compare A; every 20 ms they begin anew. */
#ifndef DL_PULSES_H
#define DL_PULSES_H

#include <Arduino.h>

#include "fast_pin.h"
#include "pins.h"
#include "ticks.h"

enum { PULSE_PEN = 0, PULSE_JOINT = 1, PULSES = PULSE_JOINT + JOINTS };
enum { PULSE_FRAME_COUNTS = 20000u * COUNTS_PER_US };

static fast_pin pulse_pins[PULSES];
static volatile uint16_t pulse_counts[PULSES]; /* 0: no pulse, the servo goes limp */

static void begin_pulse(uint8_t i, uint8_t pin) { pulse_pins[i] = begin_fast_pin(pin); }

static void set_pulse(uint8_t i, float us) {
    uint16_t counts = us < 400.0f ? 0 : us > 2600.0f ? 2600 * COUNTS_PER_US : (uint16_t)(us * COUNTS_PER_US + 0.5f);
    noInterrupts();
    pulse_counts[i] = counts;
    interrupts();
}

static volatile uint8_t nowhere;
static fast_pin pin_high = {&nowhere, 0}, pin_coming = {&nowhere, 0};
static uint16_t counts_coming = PULSE_FRAME_COUNTS;

/* What begins when the present pulse ends: the next one, or the pause until the 20 ms are over. */
static void choose_coming() {
    static uint8_t next;
    static uint16_t used;
    while (next < PULSES && !pulse_counts[next]) ++next;
    if (next < PULSES) {
        pin_coming = pulse_pins[next];
        counts_coming = pulse_counts[next++];
        used += counts_coming;
    } else {
        pin_coming.mask = 0;
        counts_coming = PULSE_FRAME_COUNTS - used;
        next = 0;
        used = 0;
    }
}

/* Both edges before anything else, so that the pulse is as long as it should be. */
ISR(TIMER1_COMPA_vect) {
    lower_pin(pin_high);
    raise_pin(pin_coming);
    OCR1A += counts_coming;
    pin_high = pin_coming;
    choose_coming();
}

#endif
