/* Three DC motors behind H-bridges, with potentiometers on A0 to A2.
 *
 * All PWM runs at 976 Hz: TIMER0's rate is the Arduino core's, TIMER2 is set to the same. */
#ifndef DL_DRIVE_DC_H
#define DL_DRIVE_DC_H

#include "pulses.h"

enum { DRIVE_KIND = DL_DRIVE_DC, DRIVE_ROBOT = DL_ROBOT_DELTA3 };

static volatile uint16_t potentiometer[JOINTS]; /* 0..1023 */
static volatile uint8_t channel;

static void convert(uint8_t next) {
    channel = next;
    ADMUX = _BV(REFS0) | next; /* against the supply, which also feeds the potentiometers */
    ADCSRA |= _BV(ADSC);
}

/* A control period begins with three conversions, 0.1 ms each; the tick is due with the last, so none is old. */
ISR(TIMER1_COMPB_vect) {
    OCR1B += TICK_US * COUNTS_PER_US;
    convert(0);
}

ISR(ADC_vect) {
    potentiometer[channel] = ADC;
    if (channel + 1 < JOINTS) convert(channel + 1);
    else tick_is_due();
}

static void drive_begin() {
    for (uint8_t j = 0; j < JOINTS; ++j) {
        pinMode(PIN_PWM[j], OUTPUT);
        pinMode(PIN_WAY[j], OUTPUT);
    }
    TCCR2A |= _BV(WGM21) | _BV(WGM20); /* fast PWM */
    ADCSRA |= _BV(ADIE);
}

static void drive_read(float *raw) {
    for (uint8_t j = 0; j < JOINTS; ++j) {
        noInterrupts();
        uint16_t value = potentiometer[j];
        interrupts();
        raw[j] = value / 1023.0f;
    }
}

static void drive_write(const dl_outputs *out) {
    for (uint8_t j = 0; j < JOINTS; ++j) {
        float share = out->powered ? out->drive[j] : 0.0f;
        bool backward = share < 0.0f;
        uint8_t duty = (uint8_t)(255.0f * (backward ? -share : share) + 0.5f);
        digitalWrite(PIN_WAY[j], backward);
        analogWrite(PIN_PWM[j], backward && BRIDGE_HAS_EQUAL_INPUTS ? 255 - duty : duty);
    }
}

#endif
