/* Where the joints are: a DC drive's sensor knows and the joint goes home; a servo is sent home; a stepper looks for
 * its switch first. */
#include <math.h>

#include "parts.h"

#define NEAR 0.02f           /* rad or m */
#define SETTLED_US 100000u
#define LIMIT_US 20000000u
#define TRAVEL 1.2f          /* of the joint's range, until the switch must have closed */

static void head_home(dl_machine *m, const float *from)
{
    dl_place(m, from);
    m->state_us = m->now_us;
    m->settled_us = 0;
}

void dl_homing_begin(dl_machine *m)
{
    uint8_t searches = m->build.drive == DL_DRIVE_STEPPER;
    m->state = DL_HOMING;
    m->homed = 0;
    m->pen_down = 0;
    m->found = searches ? 0 : (uint8_t)((1 << m->joints) - 1);
    head_home(m, m->position); /* a servo's is home already */
}

static float speed_of(const dl_machine *m, uint8_t joint)
{
    return m->settings[DL_HOME_SPEED] * dl_joint(m->settings, joint, DL_SPEED);
}

/* The switch is where the joint is at its lower limit. */
static void take_origin(dl_machine *m, uint8_t joint)
{
    float low = dl_joint(m->settings, joint, DL_MIN);
    float from_offset = low - dl_joint(m->settings, joint, DL_OFFSET);
    m->origin[joint] = m->inputs.raw[joint] - from_offset / dl_joint(m->settings, joint, DL_SCALE);
    m->position[joint] = low;
    m->motion.setpoint[joint] = low;
    m->motion.velocity[joint] = 0.0f;
    m->found |= (uint8_t)(1 << joint);
}

static void search_switch(dl_machine *m, uint8_t joint, float dt)
{
    float range = dl_joint(m->settings, joint, DL_MAX) - dl_joint(m->settings, joint, DL_MIN);
    float travelled = speed_of(m, joint) * 1e-6f * (float)(m->now_us - m->state_us);
    if (m->inputs.limit_switches >> joint & 1) {
        take_origin(m, joint);
    } else if (travelled > TRAVEL * range) {
        dl_fail(m, DL_FAULT_HOMING, joint + 1);
    } else {
        dl_motion_approach(&m->motion, joint, -INFINITY, speed_of(m, joint), dt);
    }
}

static void search(dl_machine *m, uint8_t all, float dt)
{
    for (uint8_t j = 0; j < m->joints && m->state == DL_HOMING; j++)
        if (!(m->found >> j & 1)) search_switch(m, j, dt);
    if (m->state == DL_HOMING && m->found == all) head_home(m, m->motion.setpoint);
}

/* The first joint, from 1, that is not at home yet; 0 if all are. */
static uint8_t astray(const dl_machine *m)
{
    for (uint8_t j = 0; j < m->joints; j++) {
        float home = dl_joint(m->settings, j, DL_HOME_JOINT);
        float at = m->build.drive == DL_DRIVE_SERVO ? m->motion.setpoint[j] : m->position[j];
        if (!(m->motion.setpoint[j] == home && fabsf(at - home) <= NEAR)) return j + 1;
    }
    return 0;
}

static void go_home(dl_machine *m, float dt, uint32_t dt_us)
{
    for (uint8_t j = 0; j < m->joints; j++)
        dl_motion_approach(&m->motion, j, dl_joint(m->settings, j, DL_HOME_JOINT), speed_of(m, j), dt);
    uint8_t joint = astray(m);
    m->settled_us = joint ? 0 : m->settled_us + dt_us;
    if (m->settled_us >= SETTLED_US) {
        m->homed = 1;
        dl_place(m, m->motion.setpoint);
        dl_rest(m);
    } else if (joint && m->now_us - m->state_us >= LIMIT_US) {
        dl_fail(m, DL_FAULT_HOMING, joint);
    }
}

void dl_homing_tick(dl_machine *m, float dt, uint32_t dt_us)
{
    uint8_t all = (uint8_t)((1 << m->joints) - 1);
    if (m->found == all) go_home(m, dt, dt_us);
    else search(m, all, dt);
}
