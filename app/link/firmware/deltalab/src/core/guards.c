/* What switches the motors off, and what stops them when the host is silent. */
#include <math.h>

#include "parts.h"

#define RAIL 0.02f
#define AT_SWITCH 0.005f /* rad or m above the lower limit: there a closed switch is where it belongs */

static uint8_t has_sensors(const dl_machine *m)
{
    return m->build.drive == DL_DRIVE_DC;
}

uint8_t dl_sensor_broken(const dl_machine *m, uint8_t joint)
{
    float raw = m->inputs.raw[joint];
    return has_sensors(m) && !(raw >= RAIL && raw <= 1.0f - RAIL);
}

float dl_room(const dl_machine *m, uint8_t joint, float position)
{
    float low = dl_joint(m->settings, joint, DL_MIN), high = dl_joint(m->settings, joint, DL_MAX);
    return fminf(position - low, high - position);
}

static uint8_t beyond_limits(const dl_machine *m, uint8_t joint)
{
    uint8_t known = has_sensors(m) || (m->build.drive == DL_DRIVE_STEPPER && m->homed);
    return known && m->state != DL_HOMING && !(dl_room(m, joint, m->position[joint]) >= -DL_BEYOND);
}

static uint8_t switch_closed(const dl_machine *m, uint8_t joint)
{
    uint8_t moves = m->state == DL_MOVING || m->state == DL_TESTING;
    uint8_t at_switch = m->position[joint] <= dl_joint(m->settings, joint, DL_MIN) + AT_SWITCH;
    return moves && !at_switch && (m->inputs.limit_switches >> joint & 1);
}

static uint8_t lags_behind(dl_machine *m, uint8_t joint, uint32_t dt_us)
{
    float error = fabsf(m->motion.setpoint[joint] - m->position[joint]);
    uint8_t far = has_sensors(m) && m->state != DL_TESTING && error > m->settings[DL_FOLLOWING];
    m->following_us[joint] = far ? m->following_us[joint] + dt_us : 0;
    return far && (float)m->following_us[joint] >= 1000.0f * m->settings[DL_FOLLOWING_TIME];
}

static uint8_t joint_fault(dl_machine *m, uint8_t joint, uint32_t dt_us)
{
    if (dl_sensor_broken(m, joint)) return DL_FAULT_SENSOR;
    if (beyond_limits(m, joint)) return DL_FAULT_LIMIT;
    if (switch_closed(m, joint)) return DL_FAULT_SWITCH;
    if (lags_behind(m, joint, dt_us)) return DL_FAULT_FOLLOWING;
    return DL_FAULT_NONE;
}

static void watch_joints(dl_machine *m, uint32_t dt_us)
{
    for (uint8_t j = 0; j < m->joints; j++) {
        uint8_t fault = joint_fault(m, j, dt_us);
        if (fault == DL_FAULT_NONE) continue;
        dl_fail(m, fault, j + 1);
        return;
    }
}

static uint8_t silent_since(const dl_machine *m, uint32_t since_us, uint8_t setting)
{
    return (float)(m->now_us - since_us) >= 1000.0f * m->settings[setting];
}

static void watch_host(dl_machine *m)
{
    if (silent_since(m, m->frame_us, DL_OFF_AFTER)) {
        dl_power_off(m, DL_OFF);
    } else if (m->state == DL_MOVING) {
        if (silent_since(m, m->setpoint_us, DL_HOLD_AFTER)) dl_stop(m, DL_HELD);
    } else if (m->state == DL_HOMING || m->state == DL_TESTING) {
        if (silent_since(m, m->frame_us, DL_HOLD_AFTER)) dl_stop(m, DL_HELD);
    }
}

void dl_guard(dl_machine *m, uint32_t dt_us)
{
    if (m->inputs.estop_open && m->state != DL_FAULT) dl_fail(m, DL_FAULT_ESTOP, 0);
    if (dl_is_powered(m)) watch_joints(m, dt_us);
    if (dl_is_powered(m)) watch_host(m);
}
