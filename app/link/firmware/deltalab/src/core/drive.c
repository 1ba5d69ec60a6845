/* From set-points to what the motors get. */
#include <math.h>

#include "parts.h"

float dl_laser(const dl_machine *m)
{
    return m->state == DL_MOVING ? (float)m->laser / 255.0f : 0.0f;
}

/* Share of the supply for a DC motor. */
static float control(dl_machine *m, uint8_t j)
{
    float duty_max = m->settings[DL_DUTY_MAX], supply = m->settings[DL_SUPPLY];
    if (m->state == DL_TESTING && m->test.kind == DL_TEST_PULSE && m->test.joint == j)
        return fminf(fmaxf(m->test.amplitude, -duty_max), duty_max);
    const float *gains = m->settings + DL_JOINT_SETTINGS * j;
    float error = m->motion.setpoint[j] - m->position[j];
    float volts = dl_pid_step(&m->pid[j], gains, 1e-6f * (float)m->build.period_us, error, duty_max * supply);
    return volts / supply;
}

static float raw_of(const dl_machine *m, uint8_t j)
{
    float from_offset = m->motion.setpoint[j] - dl_joint(m->settings, j, DL_OFFSET);
    return m->origin[j] + from_offset / dl_joint(m->settings, j, DL_SCALE);
}

static float output(dl_machine *m, uint8_t j, uint8_t powered)
{
    m->drive[j] = powered && m->build.drive == DL_DRIVE_DC ? control(m, j) : 0.0f;
    if (m->build.drive == DL_DRIVE_DC) return m->drive[j];
    if (powered) return raw_of(m, j);
    return m->build.drive == DL_DRIVE_STEPPER ? m->inputs.raw[j] : 0.0f;
}

void dl_drive(dl_machine *m, dl_outputs *out)
{
    out->powered = dl_is_powered(m);
    for (uint8_t j = 0; j < DL_JOINTS; j++) out->drive[j] = j < m->joints ? output(m, j, out->powered) : 0.0f;
    out->pen_us = m->settings[m->pen_down ? DL_PEN_DOWN : DL_PEN_UP];
    out->laser = dl_laser(m);
}
