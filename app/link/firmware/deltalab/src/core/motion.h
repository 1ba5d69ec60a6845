/* The set-point of each joint on its way to the newest target. */
#ifndef DL_MOTION_H
#define DL_MOTION_H

#include <stdint.h>

#include "settings.h"

typedef struct {
    float setpoint[DL_JOINTS]; /* rad or m */
    float target[DL_JOINTS];
    float velocity[DL_JOINTS]; /* of the set-point, rad/s or m/s */
    float time_left;           /* s until the set-point is at its target */
    float stop_left;           /* s until a controlled stop is at rest; 0 if there is none */
} dl_motion;

/* At rest, here. */
void dl_motion_place(dl_motion *motion, const float *joints);
/* From now on towards `target`, which is reached after `time` seconds, or later where a joint's speed demands it. */
void dl_motion_aim(dl_motion *motion, const float *settings, uint8_t joints, const float *target, float time);
/* The set-point goes on as it does, slower and slower, within the limits. */
void dl_motion_stop(dl_motion *motion, const float *settings);
/* `dt` seconds later. */
void dl_motion_run(dl_motion *motion, const float *settings, float dt);
/* One joint alone goes towards `goal` at `speed`; 1 when it is there. */
uint8_t dl_motion_approach(dl_motion *motion, uint8_t joint, float goal, float speed, float dt);

#endif
