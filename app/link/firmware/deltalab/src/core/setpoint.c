/* Which set-points are accepted, and what they do. */
#include <math.h>

#include "bytes.h"
#include "kinematics.h"
#include "parts.h"

#define TOLERANCE 1e-4f /* rad or m: a target on its limit is still one after rounding */

/* As it came. */
typedef struct {
    uint8_t kind, flags, laser;
    float target[4];
} wish;

static uint8_t check_numbers(const wish *wanted)
{
    if (wanted->kind > DL_KIND_POSE || wanted->flags & ~(DL_SETPOINT_MANUAL | DL_SETPOINT_PEN_DOWN))
        return DL_REFUSED_VALUE;
    for (uint8_t i = 0; i < 4; i++)
        if (!isfinite(wanted->target[i])) return DL_REFUSED_VALUE;
    return DL_REFUSED_OK;
}

static uint8_t check_joint(const dl_machine *m, uint8_t j, float *q)
{
    float low = dl_joint(m->settings, j, DL_MIN), high = dl_joint(m->settings, j, DL_MAX);
    if (!(*q >= low - TOLERANCE && *q <= high + TOLERANCE)) return DL_REFUSED_LIMIT;
    *q = fminf(fmaxf(*q, low), high);
    return DL_REFUSED_OK;
}

static uint8_t is_jump(const dl_machine *m, const float *joints)
{
    for (uint8_t j = 0; j < m->joints; j++) {
        float farthest = m->settings[DL_JUMP] * dl_joint(m->settings, j, DL_SPEED);
        if (!(fabsf(joints[j] - m->motion.setpoint[j]) <= farthest)) return 1;
    }
    return 0;
}

/* The joints of the target, brought back onto the limits that rounding missed. */
static uint8_t find_joints(const dl_machine *m, const wish *wanted, float *joints)
{
    uint8_t pose = wanted->kind == DL_KIND_POSE;
    if (!m->homed && (pose || !(wanted->flags & DL_SETPOINT_MANUAL))) return DL_REFUSED_NOT_HOMED;
    if (pose && !dl_inverse(m->build.robot, m->settings + DL_GEOMETRY, wanted->target, joints)) return DL_REFUSED_REACH;
    for (uint8_t j = 0; j < m->joints; j++) {
        if (!pose) joints[j] = wanted->target[j];
        if (check_joint(m, j, &joints[j]) != DL_REFUSED_OK) return DL_REFUSED_LIMIT;
    }
    return is_jump(m, joints) ? DL_REFUSED_JUMP : DL_REFUSED_OK;
}

/* Seconds between the last two: so long the joints take to the newest target. */
static float interval(const dl_machine *m)
{
    float apart = 1e-6f * (float)(m->now_us - m->setpoint_us);
    return fminf(fmaxf(apart, 0.010f), 0.040f);
}

static uint8_t moves(const dl_machine *m, const float *joints)
{
    for (uint8_t j = 0; j < m->joints; j++)
        if (joints[j] != m->motion.setpoint[j]) return 1;
    return m->motion.stop_left > 0.0f;
}

static void follow(dl_machine *m, const wish *wanted, const float *joints)
{
    m->manual = wanted->flags & DL_SETPOINT_MANUAL;
    m->pen_down = (wanted->flags & DL_SETPOINT_PEN_DOWN) != 0;
    m->laser = wanted->laser;
    if (m->state == DL_READY && moves(m, joints)) {
        m->state = DL_MOVING;
        m->settled_us = 0;
    }
    dl_tool_look_again(&m->tool);
    dl_motion_aim(&m->motion, m->settings, m->joints, joints, interval(m));
    m->setpoint_us = m->now_us;
}

uint8_t dl_accept_setpoint(dl_machine *m, const uint8_t *fields)
{
    wish wanted = {fields[0], fields[1], fields[2], {0}};
    float joints[DL_JOINTS] = {0};
    for (uint8_t i = 0; i < 4; i++) wanted.target[i] = dl_get_f32(fields + 3 + 4 * i);
    uint8_t refusal = m->state == DL_MOVING ? DL_REFUSED_OK : dl_state_refusal(m);
    if (refusal == DL_REFUSED_OK) refusal = check_numbers(&wanted);
    if (refusal == DL_REFUSED_OK) refusal = find_joints(m, &wanted, joints);
    if (refusal == DL_REFUSED_OK) follow(m, &wanted, joints);
    return refusal;
}
