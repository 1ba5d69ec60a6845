#include "settings.h"

#include <math.h>
#include <string.h>

#include "codes.h"
#include "frame.h"
#include "robots.h"

#ifdef __AVR__
#define copy_from_flash memcpy_P
#else
#define copy_from_flash memcpy
#endif

#define LARGEST 1e6f  /* so that nothing that is computed from settings overflows */
#define SMALLEST 1e-9f /* of what is divided by, or would forbid every motion */

typedef struct {
    float low, high;
} range;

uint8_t dl_joints(uint8_t robot)
{
    return robot == DL_ROBOT_DELTA3 || robot == DL_ROBOT_LINEAR ? 3 : 4;
}

uint8_t dl_defaults(const dl_build *build, float *settings)
{
    memset(settings, 0, DL_SETTINGS * sizeof(float));
    for (uint8_t i = 0; i < sizeof DL_BUILT_IN / sizeof DL_BUILT_IN[0]; i++) {
        uint8_t key[2];
        copy_from_flash(key, DL_BUILT_IN[i].key, sizeof key);
        if (key[0] != build->robot || key[1] != build->drive) continue;
        copy_from_flash(settings, DL_BUILT_IN[i].settings, DL_SETTINGS * sizeof(float));
        return 1;
    }
    return 0;
}

uint16_t dl_image_crc(const dl_build *build, const uint8_t *settings)
{
    uint16_t crc = dl_crc16(0xFFFF, DL_PROTOCOL);
    crc = dl_crc16(crc, build->robot);
    crc = dl_crc16(crc, build->drive);
    for (uint16_t i = 0; i < DL_IMAGE_BYTES - 2; i++) crc = dl_crc16(crc, settings[i]);
    return crc;
}

/* Memory that was never written. */
static uint8_t is_blank(const uint8_t *image)
{
    for (uint16_t i = 0; i < DL_IMAGE_BYTES; i++)
        if (image[i] != 0xFF) return 0;
    return 1;
}

uint8_t dl_load_settings(const dl_build *build, const uint8_t *stored, float *settings)
{
    if (!stored || is_blank(stored)) return DL_SETTINGS_BUILT_IN;
    uint16_t crc = (uint16_t)(stored[DL_IMAGE_BYTES - 2] << 8 | stored[DL_IMAGE_BYTES - 1]);
    if (crc != dl_image_crc(build, stored)) return DL_SETTINGS_DAMAGED;
    memcpy(settings, stored, DL_IMAGE_BYTES - 2);
    return DL_SETTINGS_STORED;
}

uint8_t dl_is_live(uint8_t id)
{
    if (id < DL_JOINTS * DL_JOINT_SETTINGS) return id % DL_JOINT_SETTINGS <= DL_N;
    return id == DL_TOOL_SPEED || id == DL_PEN_UP || id == DL_PEN_DOWN;
}

/* Of a setting of a joint; the others of the joint stay as they are. */
static range joint_range(const float *joint, uint8_t which)
{
    switch (which) {
    case DL_MIN: return (range){-LARGEST, joint[DL_MAX]};
    case DL_MAX: return (range){joint[DL_MIN], LARGEST};
    case DL_HOME_JOINT: return (range){joint[DL_MIN], joint[DL_MAX]};
    case DL_OFFSET: case DL_SCALE: return (range){-LARGEST, LARGEST};
    default: return (range){0.0f, LARGEST};
    }
}

static range board_range(uint8_t id)
{
    switch (id) {
    case DL_TOOL_SPEED: return (range){0.0f, 0.25f};
    case DL_HOLD_AFTER: return (range){20.0f, 150.0f};
    case DL_OFF_AFTER: return (range){200.0f, 5000.0f};
    case DL_FOLLOWING_TIME: return (range){0.0f, 60000.0f};
    case DL_HOME_SPEED: case DL_DUTY_MAX: return (range){0.0f, 1.0f};
    case DL_SERIAL: return (range){0.0f, 16777215.0f};
    case DL_PEN_UP: case DL_PEN_DOWN: return (range){500.0f, 2500.0f};
    case DL_STOP_TIME: return (range){10.0f, 80.0f};
    case DL_JUMP: case DL_FOLLOWING: case DL_SUPPLY: return (range){0.0f, LARGEST};
    default: return (range){-LARGEST, LARGEST}; /* geometry */
    }
}

static uint8_t may_be_zero(uint8_t id)
{
    if (id >= DL_GEOMETRY) return 1;
    if (id < DL_JOINTS * DL_JOINT_SETTINGS) {
        uint8_t which = id % DL_JOINT_SETTINGS;
        return which != DL_SPEED && which != DL_SCALE;
    }
    return id == DL_FOLLOWING_TIME || id == DL_SERIAL;
}

uint8_t dl_check_setting(const dl_build *build, const float *settings, uint8_t id, float value)
{
    uint8_t joint = id / DL_JOINT_SETTINGS, which = id % DL_JOINT_SETTINGS;
    uint8_t of_joint = joint < DL_JOINTS;
    if (id >= DL_SETTINGS || (of_joint && joint >= dl_joints(build->robot))) return DL_REFUSED_UNKNOWN;
    range allowed = of_joint ? joint_range(settings + DL_JOINT_SETTINGS * joint, which) : board_range(id);
    if (!(value >= allowed.low && value <= allowed.high)) return DL_REFUSED_VALUE;
    if (fabsf(value) < SMALLEST && !may_be_zero(id)) return DL_REFUSED_VALUE;
    if (of_joint && ((which == DL_MIN && value == allowed.high) || (which == DL_MAX && value == allowed.low)))
        return DL_REFUSED_VALUE; /* the limits have room between them */
    if (id == DL_SERIAL && (value != floorf(value) || (settings[id] != 0.0f && value != settings[id])))
        return DL_REFUSED_VALUE; /* written once */
    return DL_REFUSED_OK;
}

uint32_t dl_geometry_hash(const float *settings)
{
    const uint8_t *bytes = (const uint8_t *)(settings + DL_GEOMETRY);
    uint32_t crc = 0xFFFFFFFFu;
    for (uint8_t i = 0; i < DL_GEOMETRY_SIZE * sizeof(float); i++) {
        crc ^= bytes[i];
        for (uint8_t bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320u : 0);
    }
    return ~crc;
}
