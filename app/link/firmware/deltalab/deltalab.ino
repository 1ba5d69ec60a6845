/* Delta Lab's firmware for the Arduino Uno: the core in src/core, wired to this board's pins, timers and memory.
 *
 * A delta with three RC servos needs no change. For another robot take the two slashes off its line: */
// #define DL_BUILD_DELTA3_DC       /* delta with three DC motors, H-bridges and potentiometers */
// #define DL_BUILD_LINEAR_STEPPER  /* linear delta with three stepper drivers */
#if !defined DL_BUILD_DELTA3_DC && !defined DL_BUILD_LINEAR_STEPPER && !defined DL_BUILD_DELTA3_SERVO
#define DL_BUILD_DELTA3_SERVO
#endif

#include <Arduino.h>
#include <avr/wdt.h>

#include "pins.h"
#include "src/core/machine.h"

static dl_machine machine;

#include "reset_cause.h"
#include "ticks.h"
#include "pulses.h"
#include "storage.h"
#if defined DL_BUILD_DELTA3_SERVO
#include "drive_servo.h"
#elif defined DL_BUILD_DELTA3_DC
#include "drive_dc.h"
#else
#include "drive_stepper.h"
#endif

static void begin_pins() {
    digitalWrite(PIN_POWER, !POWER_ON);
    pinMode(PIN_POWER, OUTPUT);
    pinMode(PIN_LASER, OUTPUT);
    pinMode(PIN_LED, OUTPUT);
    pinMode(PIN_ESTOP, INPUT_PULLUP);
    for (uint8_t j = 0; j < JOINTS; ++j) pinMode(PIN_SWITCH[j], INPUT_PULLUP);
}

static void read_inputs(dl_inputs *in) {
    memset(in, 0, sizeof *in);
    for (uint8_t j = 0; j < JOINTS; ++j) {
        if (digitalRead(PIN_SWITCH[j]) == LOW) in->limit_switches |= 1 << j;
    }
    in->estop_open = digitalRead(PIN_ESTOP) == HIGH; /* normally closed to ground: a broken wire reads as pressed */
    in->load = load_percent;
    drive_read(in->raw);
}

static void write_outputs(const dl_outputs *out) {
    drive_write(out);
    digitalWrite(PIN_POWER, out->powered ? POWER_ON : !POWER_ON);
    digitalWrite(PIN_LED, out->powered);
    analogWrite(PIN_LASER, (uint8_t)(255.0f * out->laser + 0.5f));
    set_pulse(PULSE_PEN, out->pen_us);
}

/* One control period. The hardware watchdog is fed here and nowhere else. */
__attribute__((noinline)) static void control() {
    dl_inputs in;
    dl_outputs out;
    read_inputs(&in);
    dl_tick(&machine, micros(), &in, &out);
    write_outputs(&out);
    wdt_reset();
}

static void receive() {
    while (Serial.available()) dl_receive(&machine, (uint8_t)Serial.read());
}

/* Serial.write would wait for room, so a frame is asked for only when there is room for the longest. */
static void transmit() {
    if (Serial.availableForWrite() < DL_FRAME_MAX) return;
    uint8_t frame[DL_FRAME_MAX];
    uint8_t size = dl_transmit(&machine, frame);
    if (size) Serial.write(frame, size);
}

/* A function of its own, so that the image leaves the stack again. */
__attribute__((noinline)) static void start_machine() {
    static const dl_build build = {DL_BOARD_UNO, DRIVE_ROBOT, DRIVE_KIND, TICK_US};
    uint8_t image[DL_IMAGE_BYTES];
    eeprom_read_block(image, NULL, DL_IMAGE_BYTES);
    dl_start(&machine, &build, reset_cause(), 0, image);
}

void setup() {
    begin_pins();
    begin_pulse(PULSE_PEN, PIN_PEN);
    drive_begin();
    start_machine();
    Serial.begin(115200);
    begin_timer1();
    wdt_enable(WDTO_60MS);
}

void loop() {
    receive();
    if (take_tick()) control();
    transmit();
    continue_saving();
    rest();
}
