/* Three stepper drivers with step and direction. A timer interrupt at 8 kHz spreads the steps of a control period
 * evenly over its 40 slots; a target farther away than one step a slot is reached in the periods after. */
#ifndef DL_DRIVE_STEPPER_H
#define DL_DRIVE_STEPPER_H

#include "pulses.h"

enum { DRIVE_KIND = DL_DRIVE_STEPPER, DRIVE_ROBOT = DL_ROBOT_LINEAR };
enum { SLOT_US = 125, SLOTS_PER_TICK = TICK_US / SLOT_US };

typedef struct {
    fast_pin pin;
    int8_t way;                 /* +1 or -1 */
    volatile uint8_t remaining; /* steps still to make in this period */
    uint8_t steps;              /* of this period in all */
    uint8_t accumulated;        /* of SLOTS_PER_TICK: a step is due when it overflows */
    int32_t position;           /* steps made since the start */
} stepper;

static stepper steppers[JOINTS];

ISR(TIMER2_COMPA_vect) {
    for (uint8_t j = 0; j < JOINTS; ++j) lower_pin(steppers[j].pin); /* a pulse lasts one slot */
    uint8_t left = 0;
    for (uint8_t j = 0; j < JOINTS; ++j) {
        stepper *s = &steppers[j];
        if (!s->remaining) continue;
        left = 1;
        s->accumulated += s->steps;
        if (s->accumulated < SLOTS_PER_TICK) continue;
        s->accumulated -= SLOTS_PER_TICK;
        raise_pin(s->pin);
        s->position += s->way;
        --s->remaining;
    }
    if (!left) TIMSK2 = 0;
    counts_awake += TCNT2; /* which began at 0 when this interrupt came, at the same 2 MHz */
}

static void drive_begin() {
    for (uint8_t j = 0; j < JOINTS; ++j) {
        pinMode(PIN_DIRECTION[j], OUTPUT);
        steppers[j].pin = begin_fast_pin(PIN_STEP[j]);
    }
    TCCR2A = _BV(WGM21); /* counts to OCR2A */
    TCCR2B = _BV(CS21);  /* 2 MHz */
    OCR2A = SLOT_US * 2 - 1;
}

static int32_t position(uint8_t j) {
    noInterrupts();
    int32_t steps = steppers[j].position;
    interrupts();
    return steps;
}

static void drive_read(float *raw) {
    for (uint8_t j = 0; j < JOINTS; ++j) raw[j] = position(j);
}

static void set_target(uint8_t j, int32_t target) {
    stepper *s = &steppers[j];
    s->remaining = 0; /* no step may come between the new direction and its count */
    int32_t way = target - position(j);
    uint8_t steps = (uint8_t)min((int32_t)SLOTS_PER_TICK, labs(way));
    digitalWrite(PIN_DIRECTION[j], way > 0);
    noInterrupts();
    s->way = way > 0 ? 1 : -1;
    s->steps = s->remaining = steps;
    s->accumulated = SLOTS_PER_TICK / 2;
    if (steps) TIMSK2 = _BV(OCIE2A);
    interrupts();
}

static void drive_write(const dl_outputs *out) {
    for (uint8_t j = 0; j < JOINTS; ++j) set_target(j, out->powered ? lroundf(out->drive[j]) : position(j));
}

ISR(TIMER1_COMPB_vect) {
    OCR1B += TICK_US * COUNTS_PER_US;
    tick_is_due();
}

#endif
