#include <string.h>

#include "parts.h"

uint8_t dl_is_powered(const dl_machine *m)
{
    return m->state != DL_OFF && m->state != DL_FAULT;
}

uint8_t dl_state_refusal(const dl_machine *m)
{
    switch (m->state) {
    case DL_READY: return DL_REFUSED_OK;
    case DL_OFF: return DL_REFUSED_NOT_ENABLED;
    case DL_HELD: return DL_REFUSED_HELD;
    case DL_STOPPED: return DL_REFUSED_STOPPED;
    case DL_FAULT: return DL_REFUSED_FAULT;
    default: return DL_REFUSED_BUSY;
    }
}

void dl_place(dl_machine *m, const float *joints)
{
    dl_motion_place(&m->motion, joints);
    dl_tool_lose(&m->tool, &m->build, m->settings, m->motion.setpoint);
}

void dl_lie(dl_machine *m)
{
    for (uint8_t j = 0; j < m->joints && m->build.drive == DL_DRIVE_SERVO; j++)
        m->position[j] = dl_joint(m->settings, j, DL_HOME_JOINT);
    dl_place(m, m->position);
}

void dl_rest(dl_machine *m)
{
    m->state = DL_READY;
    m->laser = 0;
}

void dl_power_on(dl_machine *m)
{
    memset(m->pid, 0, sizeof m->pid);
    memset(m->following_us, 0, sizeof m->following_us);
    dl_lie(m);
    dl_rest(m);
}

void dl_power_off(dl_machine *m, uint8_t state)
{
    m->state = state;
    m->laser = 0;
    m->pen_down = 0;
    if (m->build.drive == DL_DRIVE_DC) return; /* its sensor knows where it is */
    m->homed = 0; /* without power nobody knows where the arms go, and no sensor tells */
}

void dl_fail(dl_machine *m, uint8_t fault, uint8_t joint)
{
    dl_power_off(m, DL_FAULT);
    m->fault = fault;
    m->fault_joint = joint;
}

void dl_stop(dl_machine *m, uint8_t state)
{
    if (m->state == DL_TESTING) dl_test_release(m);
    dl_motion_stop(&m->motion, m->settings);
    dl_rest(m);
    m->state = state;
}
