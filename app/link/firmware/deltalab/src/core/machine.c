#include "machine.h"

#include <math.h>
#include <string.h>

#include "parts.h"

#define AT_TARGET_US 100000u
#define LATE_TICKS 4 /* after so many missed ticks the set-point does not make up for more */

uint8_t dl_start(dl_machine *m, const dl_build *build, uint8_t reset, uint32_t serial, const uint8_t *stored)
{
    memset(m, 0, sizeof *m);
    m->build = *build;
    m->joints = dl_joints(build->robot);
    m->reset = reset;
    m->serial = serial;
    uint8_t known = dl_defaults(build, m->settings);
    m->settings_source = dl_load_settings(build, stored, m->settings);
    if (serial) m->settings[DL_SERIAL] = (float)serial;
    m->geometry = dl_geometry_hash(m->settings);
    dl_decoder_reset(&m->decoder);
    dl_power_off(m, DL_OFF);
    dl_lie(m);
    if (reset == DL_RESET_WATCHDOG) dl_fail(m, DL_FAULT_WATCHDOG, 0);
    return known;
}

void dl_receive(dl_machine *m, uint8_t byte)
{
    int8_t length = dl_decode(&m->decoder, byte);
    if (length == 0) return;
    if (length > 0 && dl_handle(m, m->decoder.data, (uint8_t)length)) m->good++;
    else m->bad++;
}

static void sense(dl_machine *m, const dl_inputs *in)
{
    m->inputs = *in;
    for (uint8_t j = 0; j < m->joints && m->build.drive != DL_DRIVE_SERVO; j++) {
        float raw = in->raw[j] - m->origin[j];
        m->position[j] = dl_joint(m->settings, j, DL_OFFSET) + dl_joint(m->settings, j, DL_SCALE) * raw;
    }
}

/* Only manual mode needs the tool's pose. It is found at rest and kept while the joints move in that mode. */
static void watch_tool(dl_machine *m, float dt)
{
    uint8_t stops = m->motion.stop_left > 0.0f, moves = m->motion.time_left > 0.0f;
    if (stops || (moves && !m->manual)) m->tool.known = 0;
    else if (moves && dt > 0.0f) dl_tool_limit(&m->tool, &m->build, m->settings, &m->motion, m->homed, dt);
    else if (m->manual || m->state == DL_READY) dl_tool_settle(&m->tool, &m->build, m->settings, &m->motion);
}

static void run(dl_machine *m, float dt, uint32_t dt_us)
{
    watch_tool(m, dt);
    dl_motion_run(&m->motion, m->settings, dt);
    if (m->state != DL_MOVING) return;
    m->settled_us = m->motion.time_left == 0.0f ? m->settled_us + dt_us : 0;
    if (m->settled_us >= AT_TARGET_US) dl_rest(m);
}

static void move(dl_machine *m, uint32_t dt_us)
{
    uint32_t late_us = (uint32_t)LATE_TICKS * m->build.period_us;
    float dt = 1e-6f * (float)(dt_us < late_us ? dt_us : late_us);
    if (!dl_is_powered(m)) dl_lie(m);
    else if (m->state == DL_HOMING) dl_homing_tick(m, dt, dt_us);
    else if (m->state == DL_TESTING) dl_test_tick(m);
    else run(m, dt, dt_us);
    if (m->build.drive == DL_DRIVE_SERVO) memcpy(m->position, m->motion.setpoint, sizeof m->position);
}

void dl_tick(dl_machine *m, uint32_t now_us, const dl_inputs *in, dl_outputs *out)
{
    uint32_t dt_us = m->ticked ? now_us - m->now_us : 0;
    m->now_us = now_us;
    m->ticked = 1;
    sense(m, in);
    dl_guard(m, dt_us);
    move(m, dt_us);
    dl_drive(m, out);
    dl_report_tick(m);
}
