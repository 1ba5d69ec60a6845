/* The control period, from TIMER1's compare B, and what the processor does between two: sleep. */
#ifndef DL_TICKS_H
#define DL_TICKS_H

#include <Arduino.h>
#include <avr/sleep.h>

#include "reset_cause.h"

enum {
    TICK_US = 5000,
    COUNTS_PER_US = 2,    /* TIMER1 runs at 2 MHz, free, all its 16 bits */
    TICKS_PER_LOAD = 100, /* the load is an average over half a second */
    TICKS_TILL_HUNG = 8,  /* 40 ms: before the hardware watchdog's 60 */
    WAKING_COUNTS = 10    /* 5 us of each sleep: the shortest interrupt that can end it */
};

static volatile uint8_t ticks_due;
static uint16_t ticks_missed;
static uint8_t load_percent;
static uint32_t counts_slept;
static volatile uint8_t counts_awake; /* what a long interrupt took of the present sleep */

/* In interrupts only. */
static void tick_is_due() {
    if (ticks_due < 255) ++ticks_due;
    if (ticks_due > TICKS_TILL_HUNG) reset_mark = MARK_HUNG;
}

/* Whether a control period has begun; periods that went by unused are counted and left out. */
static bool take_tick() {
    if (!ticks_due) return false;
    noInterrupts();
    ticks_missed += ticks_due - 1;
    ticks_due = 0;
    reset_mark = MARK_RUNNING;
    interrupts();
    static uint8_t ticks;
    if (++ticks == TICKS_PER_LOAD) {
        ticks = 0;
        load_percent = 100 - counts_slept / (uint32_t(TICK_US) * COUNTS_PER_US * TICKS_PER_LOAD / 100);
        counts_slept = 0;
    }
    return true;
}

/* Sleeps till the next interrupt, unless there is something to do. */
static void rest() {
    noInterrupts();
    if (ticks_due || Serial.available()) {
        interrupts();
        return;
    }
    uint16_t begin = TCNT1;
    counts_awake = 0;
    set_sleep_mode(SLEEP_MODE_IDLE);
    sleep_enable();
    interrupts(); /* takes effect one instruction later: nothing can come between this and the sleep */
    sleep_cpu();
    sleep_disable();
    noInterrupts();
    uint16_t counts = TCNT1 - begin, awake = counts_awake + WAKING_COUNTS;
    interrupts();
    if (counts > awake) counts_slept += counts - awake;
}

static void begin_timer1() {
    noInterrupts();
    TCCR1A = 0;
    TCCR1B = _BV(CS11); /* 16 MHz / 8 */
    TCNT1 = 0;
    OCR1A = 1000;
    OCR1B = TICK_US * COUNTS_PER_US;
    TIFR1 = _BV(OCF1A) | _BV(OCF1B);
    TIMSK1 = _BV(OCIE1A) | _BV(OCIE1B);
    interrupts();
}

#endif
