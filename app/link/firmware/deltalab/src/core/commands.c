/* What the host may order in which state. */
#include "parts.h"

static uint8_t clear(dl_machine *m)
{
    if (m->state == DL_OFF || m->state == DL_READY) return DL_REFUSED_OK;
    if (m->state == DL_STOPPED) {
        dl_rest(m);
        return DL_REFUSED_OK;
    }
    if (m->state != DL_FAULT) return dl_state_refusal(m);
    if (m->inputs.estop_open) return DL_REFUSED_ESTOP;
    for (uint8_t j = 0; j < m->joints && m->fault == DL_FAULT_SENSOR; j++)
        if (dl_sensor_broken(m, j)) return DL_REFUSED_FAULT;
    m->fault = DL_FAULT_NONE;
    m->fault_joint = 0;
    m->state = DL_OFF;
    return DL_REFUSED_OK;
}

static uint8_t enable(dl_machine *m)
{
    if (m->state != DL_OFF) return dl_state_refusal(m);
    if (!m->ticked) return DL_REFUSED_BUSY;
    for (uint8_t j = 0; j < m->joints && m->build.drive == DL_DRIVE_DC; j++)
        if (!(dl_room(m, j, m->position[j]) >= -DL_BEYOND)) return DL_REFUSED_LIMIT;
    dl_power_on(m);
    return DL_REFUSED_OK;
}

static uint8_t home(dl_machine *m)
{
    if (m->state == DL_HOMING) return DL_REFUSED_OK;
    uint8_t refusal = dl_state_refusal(m);
    if (refusal == DL_REFUSED_OK) dl_homing_begin(m);
    return refusal;
}

static uint8_t follow(dl_machine *m)
{
    if (m->state != DL_HELD) return dl_state_refusal(m);
    dl_rest(m);
    return DL_REFUSED_OK;
}

static uint8_t halt(dl_machine *m)
{
    uint8_t moves = m->state == DL_MOVING || m->state == DL_HOMING || m->state == DL_TESTING;
    if (!moves) return dl_state_refusal(m);
    dl_stop(m, DL_READY);
    return DL_REFUSED_OK;
}

static uint8_t stop(dl_machine *m)
{
    if (dl_is_powered(m) && m->state != DL_STOPPED) dl_stop(m, DL_STOPPED);
    return DL_REFUSED_OK;
}

static uint8_t power_off(dl_machine *m)
{
    if (dl_is_powered(m)) dl_power_off(m, DL_OFF);
    return DL_REFUSED_OK;
}

static uint8_t save(dl_machine *m)
{
    if (m->state != DL_OFF) return DL_REFUSED_BUSY;
    m->save_requested = 1;
    return DL_REFUSED_OK;
}

static uint8_t defaults(dl_machine *m)
{
    if (m->state != DL_OFF) return DL_REFUSED_BUSY;
    float serial = m->settings[DL_SERIAL];
    dl_defaults(&m->build, m->settings);
    m->settings[DL_SERIAL] = serial;
    m->geometry = dl_geometry_hash(m->settings);
    return DL_REFUSED_OK;
}

uint8_t dl_command(dl_machine *m, uint8_t command)
{
    switch (command) {
    case DL_STOP: return stop(m);
    case DL_POWER_OFF: return power_off(m);
    case DL_CLEAR: return clear(m);
    case DL_ENABLE: return enable(m);
    case DL_HOME: return home(m);
    case DL_FOLLOW: return follow(m);
    case DL_HALT: return halt(m);
    case DL_SAVE: return save(m);
    case DL_DEFAULTS: return defaults(m);
    default: return DL_REFUSED_UNKNOWN;
    }
}

static uint8_t may_set(const dl_machine *m, uint8_t id)
{
    uint8_t holding = m->state == DL_READY || m->state == DL_HELD || m->state == DL_STOPPED;
    return m->state == DL_OFF || (holding && dl_is_live(id));
}

uint8_t dl_set(dl_machine *m, uint8_t id, float value)
{
    uint8_t refusal = dl_check_setting(&m->build, m->settings, id, value);
    if (refusal == DL_REFUSED_UNKNOWN) return refusal;
    if (!may_set(m, id)) return DL_REFUSED_BUSY;
    if (refusal != DL_REFUSED_OK) return refusal;
    m->settings[id] = value;
    if (id >= DL_GEOMETRY) m->geometry = dl_geometry_hash(m->settings);
    return DL_REFUSED_OK;
}
