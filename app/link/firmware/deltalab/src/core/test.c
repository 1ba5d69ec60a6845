/* Short experiments on one DC drive: a voltage pulse, or a step of the set-point. */
#include <math.h>
#include <string.h>

#include "bytes.h"
#include "parts.h"

#define MARGIN 0.05f      /* rad or m inside the limits */
#define STEP_MAX 0.35f    /* rad or m */
#define DURATION_MAX 5000 /* ms */

static uint8_t check(const dl_machine *m, const dl_test *test)
{
    uint8_t pulse = test->kind == DL_TEST_PULSE;
    if (test->kind > DL_TEST_STEP || test->joint >= m->joints || m->build.drive != DL_DRIVE_DC)
        return DL_REFUSED_UNKNOWN;
    if (m->state != DL_READY) return dl_state_refusal(m);
    if (!(fabsf(test->amplitude) <= (pulse ? 1.0f : STEP_MAX))) return DL_REFUSED_VALUE;
    if (test->duration_us == 0 || test->duration_us > DURATION_MAX * 1000u) return DL_REFUSED_VALUE;
    if (!m->homed) return DL_REFUSED_NOT_HOMED;
    float end = m->motion.setpoint[test->joint] + (pulse ? 0.0f : test->amplitude);
    float room = fminf(dl_room(m, test->joint, m->position[test->joint]), dl_room(m, test->joint, end));
    return room > MARGIN ? DL_REFUSED_OK : DL_REFUSED_LIMIT;
}

uint8_t dl_test_begin(dl_machine *m, uint16_t number, const uint8_t *fields)
{
    if (m->state == DL_TESTING && number == m->test.number) return DL_REFUSED_OK; /* the host missed the answer */
    dl_test test = {fields[0], fields[1], number, dl_get_f32(fields + 2), 1000u * dl_get_u16(fields + 6)};
    uint8_t refusal = check(m, &test);
    if (refusal != DL_REFUSED_OK) return refusal;
    m->test = test;
    m->state = DL_TESTING;
    m->state_us = m->now_us;
    m->reports.sample_us = m->now_us - 1000000u; /* the first one is due at once */
    float joints[DL_JOINTS];
    memcpy(joints, m->motion.setpoint, sizeof joints);
    if (test.kind == DL_TEST_STEP) joints[test.joint] += test.amplitude;
    dl_place(m, joints);
    return DL_REFUSED_OK;
}

static void release_at(dl_machine *m, uint8_t joint, float position)
{
    float joints[DL_JOINTS];
    memcpy(joints, m->motion.setpoint, sizeof joints);
    joints[joint] = position;
    dl_place(m, joints);
    memset(&m->pid[joint], 0, sizeof m->pid[joint]);
}

void dl_test_release(dl_machine *m)
{
    if (m->test.kind == DL_TEST_PULSE) release_at(m, m->test.joint, m->position[m->test.joint]);
}

void dl_test_tick(dl_machine *m)
{
    uint8_t joint = m->test.joint;
    if (!(dl_room(m, joint, m->position[joint]) > MARGIN)) {
        release_at(m, joint, m->position[joint]);
        dl_rest(m);
    } else if (m->now_us - m->state_us >= m->test.duration_us) {
        dl_test_release(m);
        dl_rest(m);
    }
}
