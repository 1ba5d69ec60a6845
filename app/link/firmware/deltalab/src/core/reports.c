/* What the board says: built byte by byte in the frame itself, so that no second buffer is needed. */
#include <math.h>
#include <string.h>

#include "bytes.h"
#include "parts.h"

#define TELEMETRY_US 20000u
#define SAMPLE_US 4000u

void dl_answer(dl_machine *m, uint16_t number, uint8_t result, float value)
{
    dl_reports *reports = &m->reports;
    if (reports->ack_count == DL_ACKS) return; /* the host asks again */
    reports->acks[reports->ack_count++] = (dl_ack){number, result, value};
}

static uint8_t is_due(uint32_t *last_us, uint32_t now_us, uint32_t every_us)
{
    if (now_us - *last_us < every_us) return 0;
    *last_us = now_us - *last_us < 2 * every_us ? *last_us + every_us : now_us;
    return 1;
}

void dl_report_tick(dl_machine *m)
{
    dl_reports *reports = &m->reports;
    if (is_due(&reports->telemetry_us, m->now_us, TELEMETRY_US)) reports->telemetry = 1;
    if (m->state == DL_TESTING && is_due(&reports->sample_us, m->now_us, SAMPLE_US)) reports->sample = 1;
}

static uint8_t flags(const dl_machine *m)
{
    return (uint8_t)((m->homed ? DL_FLAG_HOMED : 0) | (m->pen_down ? DL_FLAG_PEN_DOWN : 0) |
                     (dl_laser(m) > 0.0f ? DL_FLAG_LASER_ON : 0) | (m->inputs.estop_open ? DL_FLAG_ESTOP_OPEN : 0) |
                     (dl_is_powered(m) ? DL_FLAG_POWERED : 0) | (m->manual ? DL_FLAG_MANUAL : 0));
}

static uint8_t *begin(uint8_t *at, uint8_t type, uint16_t number)
{
    return dl_put_u16(dl_put_u8(at, type), number);
}

static uint8_t *telemetry(dl_machine *m, uint8_t *at)
{
    uint8_t bytes[] = {m->state, flags(m), m->fault, m->fault_joint, m->refusal, m->inputs.limit_switches};
    m->reports.telemetry = 0;
    at = begin(at, DL_TELEMETRY, m->setpoint_number);
    for (uint8_t i = 0; i < sizeof bytes; i++) at = dl_put_u8(at, bytes[i]);
    at = dl_put_u32(at, m->now_us);
    for (uint8_t j = 0; j < DL_JOINTS; j++) at = dl_put_f32(at, m->position[j]);
    for (uint8_t j = 0; j < DL_JOINTS; j++) at = dl_put_f32(at, m->motion.setpoint[j]);
    for (uint8_t j = 0; j < DL_JOINTS; j++) at = dl_put_u8(at, (uint8_t)(int8_t)lroundf(127.0f * m->drive[j]));
    return dl_put_u8(dl_put_u16(dl_put_u16(at, m->good), m->bad), m->inputs.load);
}

static uint8_t *identity(dl_machine *m, uint8_t *at)
{
    const dl_build *build = &m->build;
    uint8_t bytes[] = {DL_PROTOCOL, build->board, build->robot, build->drive, m->joints};
    m->reports.identity = 0;
    at = begin(at, DL_IDENTITY, m->reports.identity_number);
    for (uint8_t i = 0; i < sizeof bytes; i++) at = dl_put_u8(at, bytes[i]);
    at = dl_put_u16(at, DL_FIRMWARE_MAJOR << 8 | DL_FIRMWARE_MINOR);
    at = dl_put_u16(at, build->period_us);
    at = dl_put_u32(at, m->geometry);
    at = dl_put_u32(at, m->serial ? m->serial : (uint32_t)m->settings[DL_SERIAL]);
    return dl_put_u8(dl_put_u8(at, m->reset), m->settings_source);
}

static uint8_t *ack(dl_machine *m, uint8_t *at)
{
    dl_ack *acks = m->reports.acks;
    dl_ack first = acks[0];
    memmove(acks, acks + 1, (DL_ACKS - 1) * sizeof *acks);
    m->reports.ack_count--;
    return dl_put_f32(dl_put_u8(begin(at, DL_ACK, first.number), first.result), first.value);
}

static uint8_t *sample(dl_machine *m, uint8_t *at)
{
    uint8_t joint = m->test.joint;
    m->reports.sample = 0;
    at = dl_put_u8(dl_put_u32(begin(at, DL_SAMPLE, m->test.number), m->now_us), joint);
    return dl_put_f32(dl_put_f32(at, m->position[joint]), m->drive[joint]);
}

uint8_t dl_transmit(dl_machine *m, uint8_t *frame)
{
    uint8_t *at = frame + DL_FRAME_HEAD, *end;
    if (m->reports.ack_count) end = ack(m, at);
    else if (m->reports.identity) end = identity(m, at);
    else if (m->reports.sample) end = sample(m, at);
    else if (m->reports.telemetry) end = telemetry(m, at);
    else return 0;
    return dl_encode(frame, (uint8_t)(end - at));
}

uint8_t dl_image_byte(const dl_machine *m, uint16_t i)
{
    const uint8_t *bytes = (const uint8_t *)m->settings;
    if (i < DL_IMAGE_BYTES - 2) return bytes[i];
    uint16_t crc = dl_image_crc(&m->build, bytes);
    return (uint8_t)(i == DL_IMAGE_BYTES - 2 ? crc >> 8 : crc);
}

uint8_t dl_take_save_request(dl_machine *m)
{
    uint8_t requested = m->save_requested;
    m->save_requested = 0;
    return requested;
}
