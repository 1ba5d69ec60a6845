/* Every pin of the Uno, in one place.
 *
 *   D0 D1   serial (USB)
 *   D2      emergency stop: normally closed contact to ground
 *   D5      laser, PWM
 *   D8      pen servo
 *   D12     power of the motors: relay, or enable of the drivers
 *   D13     lamp on the board: motors have power
 *   A3-A5   limit switches of joints 1 to 3: normally open contacts to ground
 *
 *            servo             DC motor                 stepper
 *   joint 1  D9                D3 PWM, D4, A0           D3 step, D4 direction
 *   joint 2  D10               D6 PWM, D7, A1           D6 step, D7 direction
 *   joint 3  D11               D11 PWM, D10, A2         D11 step, D10 direction
 */
#ifndef DL_PINS_H
#define DL_PINS_H

#include <Arduino.h>

enum { JOINTS = 3 };

static const uint8_t PIN_ESTOP = 2;
static const uint8_t PIN_LASER = 5;
static const uint8_t PIN_PEN = 8;
static const uint8_t PIN_POWER = 12;
static const uint8_t PIN_LED = LED_BUILTIN;
static const uint8_t PIN_SWITCH[JOINTS] = {A3, A4, A5};

static const uint8_t PIN_SERVO[JOINTS] = {9, 10, 11};

static const uint8_t PIN_PWM[JOINTS] = {3, 6, 11};
static const uint8_t PIN_WAY[JOINTS] = {4, 7, 10};
/* true: the bridge has two equal inputs (L298N, DRV8833, TB6612, VNH5019 with its PWM input held high);
 * false: one input for the direction and one for the PWM (Cytron, Pololu G2, DRV8838). */
static const bool BRIDGE_HAS_EQUAL_INPUTS = true;

static const uint8_t PIN_STEP[JOINTS] = {3, 6, 11};
static const uint8_t PIN_DIRECTION[JOINTS] = {4, 7, 10};

/* Stepper drivers (A4988, DRV8825, TMC2209) are enabled by a low level, relays and H-bridges by a high one. */
#if defined DL_BUILD_LINEAR_STEPPER
static const uint8_t POWER_ON = LOW;
#else
static const uint8_t POWER_ON = HIGH;
#endif

#endif
