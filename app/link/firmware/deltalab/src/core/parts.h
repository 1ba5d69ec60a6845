/* The parts of the machine, for each other; a board needs machine.h only. */
#ifndef DL_PARTS_H
#define DL_PARTS_H

#include "machine.h"

/* states.c: the ways from state to state. */
uint8_t dl_is_powered(const dl_machine *m);
/* Why something that needs READY is refused now. */
uint8_t dl_state_refusal(const dl_machine *m);
void dl_power_on(dl_machine *m);
/* Into OFF or FAULT. */
void dl_power_off(dl_machine *m, uint8_t state);
/* `joint` from 1, 0 for none. */
void dl_fail(dl_machine *m, uint8_t fault, uint8_t joint);
/* A controlled stop that ends in READY, HELD or STOPPED, which holds at once. */
void dl_stop(dl_machine *m, uint8_t state);
/* At rest where the set-points are: READY. */
void dl_rest(dl_machine *m);
/* The set-points are these now, at rest. */
void dl_place(dl_machine *m, const float *joints);
/* Without power: the set-points are where the joints are; a servo will be sent home. */
void dl_lie(dl_machine *m);

#define DL_BEYOND 0.05f /* rad or m that a position may lie beyond its limits */

/* guards.c */
/* Faults and watchdogs, before each tick's motion. */
void dl_guard(dl_machine *m, uint32_t dt_us);
uint8_t dl_sensor_broken(const dl_machine *m, uint8_t joint);
/* By how much, rad or m, the position of a joint is inside its limits. */
float dl_room(const dl_machine *m, uint8_t joint, float position);

/* homing.c, test.c: begin returns a refusal. */
void dl_homing_begin(dl_machine *m);
void dl_homing_tick(dl_machine *m, float dt, uint32_t dt_us);
uint8_t dl_test_begin(dl_machine *m, uint16_t number, const uint8_t *fields);
void dl_test_tick(dl_machine *m);
/* The joint under test is under its PID again. */
void dl_test_release(dl_machine *m);

/* messages.c: what the host asks for. `fields` follow the number. 0 if it is no message of the protocol. */
uint8_t dl_handle(dl_machine *m, const uint8_t *payload, uint8_t length);
/* setpoint.c, commands.c: return a refusal. */
uint8_t dl_accept_setpoint(dl_machine *m, const uint8_t *fields);
uint8_t dl_command(dl_machine *m, uint8_t command);
uint8_t dl_set(dl_machine *m, uint8_t id, float value);

/* drive.c: the outputs for the present set-points. */
void dl_drive(dl_machine *m, dl_outputs *out);
float dl_laser(const dl_machine *m);

/* reports.c */
void dl_answer(dl_machine *m, uint16_t number, uint8_t result, float value);
void dl_report_tick(dl_machine *m);

#endif
