/* Three RC servos. They tell nothing back: no pulse means no force. */
#ifndef DL_DRIVE_SERVO_H
#define DL_DRIVE_SERVO_H

#include "pulses.h"

enum { DRIVE_KIND = DL_DRIVE_SERVO, DRIVE_ROBOT = DL_ROBOT_DELTA3 };

static void drive_begin() {
    for (uint8_t j = 0; j < JOINTS; ++j) begin_pulse(PULSE_JOINT + j, PIN_SERVO[j]);
}

static void drive_read(float *) {}

static void drive_write(const dl_outputs *out) {
    for (uint8_t j = 0; j < JOINTS; ++j) set_pulse(PULSE_JOINT + j, out->powered ? out->drive[j] : 0.0f);
}

ISR(TIMER1_COMPB_vect) {
    OCR1B += TICK_US * COUNTS_PER_US;
    tick_is_due();
}

#endif
