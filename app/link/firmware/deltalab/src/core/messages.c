/* What came from the host, by type. */
#include <math.h>

#include "bytes.h"
#include "parts.h"

/* Of the whole payload; 0 for types that a host does not send. */
static uint8_t length_of(uint8_t type)
{
    switch (type) {
    case DL_HELLO: case DL_ALIVE: return 3;
    case DL_SETPOINT: return 22;
    case DL_COMMAND: return 5;
    case DL_SET: return 8;
    case DL_GET: return 4;
    case DL_TEST: return 11;
    default: return 0;
    }
}

static void setpoint(dl_machine *m, uint16_t number, const uint8_t *fields)
{
    m->refusal = dl_accept_setpoint(m, fields);
    if (m->refusal == DL_REFUSED_OK) m->setpoint_number = number;
}

/* An order that is done ends what telemetry says about the last set-point. */
static void order(dl_machine *m, uint16_t number, uint8_t refusal)
{
    if (refusal == DL_REFUSED_OK) m->refusal = DL_REFUSED_OK;
    dl_answer(m, number, refusal, 0.0f);
}

static float value_of(const dl_machine *m, uint8_t id)
{
    return id < DL_SETTINGS ? m->settings[id] : 0.0f;
}

uint8_t dl_handle(dl_machine *m, const uint8_t *payload, uint8_t length)
{
    const uint8_t *fields = payload + 3;
    uint8_t type = payload[0];
    uint16_t number = dl_get_u16(payload + 1);
    if (length != length_of(type)) return 0;
    m->frame_us = m->now_us;
    if (type == DL_SETPOINT) setpoint(m, number, fields);
    if (type == DL_COMMAND) order(m, number, dl_command(m, fields[0]));
    if (type == DL_TEST) order(m, number, dl_test_begin(m, number, fields));
    if (type == DL_SET) {
        uint8_t refusal = dl_set(m, fields[0], dl_get_f32(fields + 1));
        dl_answer(m, number, refusal, value_of(m, fields[0]));
    }
    if (type == DL_GET) {
        uint8_t refusal = fields[0] < DL_SETTINGS ? DL_REFUSED_OK : DL_REFUSED_UNKNOWN;
        dl_answer(m, number, refusal, value_of(m, fields[0]));
    }
    if (type == DL_HELLO) {
        m->reports.identity = 1;
        m->reports.identity_number = number;
    }
    return 1;
}
