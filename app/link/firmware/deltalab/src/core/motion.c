#include "motion.h"

#include <math.h>
#include <string.h>

void dl_motion_place(dl_motion *motion, const float *joints)
{
    memcpy(motion->setpoint, joints, sizeof motion->setpoint);
    memcpy(motion->target, joints, sizeof motion->target);
    memset(motion->velocity, 0, sizeof motion->velocity);
    motion->time_left = 0.0f;
    motion->stop_left = 0.0f;
}

void dl_motion_aim(dl_motion *motion, const float *settings, uint8_t joints, const float *target, float time)
{
    float farthest = 0.0f;
    uint8_t known = motion->stop_left == 0.0f && motion->time_left > 0.0f;
    for (uint8_t j = 0; j < joints; j++) known = known && motion->target[j] == target[j];
    if (known) return; /* a repeated target does not put its own arrival off */
    motion->stop_left = 0.0f;
    for (uint8_t j = 0; j < joints; j++) {
        float way = fabsf(target[j] - motion->setpoint[j]);
        motion->target[j] = target[j];
        farthest = fmaxf(farthest, way);
        time = fmaxf(time, way / dl_joint(settings, j, DL_SPEED));
    }
    motion->time_left = farthest > 0.0f ? time : 0.0f;
}

void dl_motion_stop(dl_motion *motion, const float *settings)
{
    if (motion->stop_left == 0.0f) motion->stop_left = 0.001f * settings[DL_STOP_TIME];
}

/* A joint that would leave its limits stops there; one that is outside already does not jump back. */
static float within(float from, float to, float low, float high)
{
    if (to > from && to > high) return fmaxf(from, high);
    if (to < from && to < low) return fminf(from, low);
    return to;
}

static void slow_down(dl_motion *motion, const float *settings, float dt)
{
    float whole = 0.001f * settings[DL_STOP_TIME];
    float rest = fmaxf(motion->stop_left - dt, 0.0f);
    /* The way under a speed that falls linearly. */
    float way = 0.5f * (motion->stop_left + rest) / whole * (motion->stop_left - rest);
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        float from = motion->setpoint[j], to = from + way * motion->velocity[j];
        motion->setpoint[j] = within(from, to, dl_joint(settings, j, DL_MIN), dl_joint(settings, j, DL_MAX));
    }
    motion->stop_left = rest;
    if (rest == 0.0f) dl_motion_place(motion, motion->setpoint);
}

static void go_on(dl_motion *motion, float dt)
{
    float share = dt < motion->time_left ? dt / motion->time_left : 1.0f;
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        float way = motion->target[j] - motion->setpoint[j];
        motion->velocity[j] = way / motion->time_left;
        motion->setpoint[j] = share < 1.0f ? motion->setpoint[j] + share * way : motion->target[j];
    }
    motion->time_left = fmaxf(motion->time_left - dt, 0.0f);
}

void dl_motion_run(dl_motion *motion, const float *settings, float dt)
{
    if (motion->stop_left > 0.0f) slow_down(motion, settings, dt);
    else if (motion->time_left > 0.0f) go_on(motion, dt);
    else memset(motion->velocity, 0, sizeof motion->velocity);
}

uint8_t dl_motion_approach(dl_motion *motion, uint8_t joint, float goal, float speed, float dt)
{
    float way = goal - motion->setpoint[joint];
    float reach = speed * dt;
    uint8_t there = fabsf(way) <= reach;
    motion->velocity[joint] = there ? 0.0f : copysignf(speed, way);
    motion->setpoint[joint] = there ? goal : motion->setpoint[joint] + copysignf(reach, way);
    return there;
}
