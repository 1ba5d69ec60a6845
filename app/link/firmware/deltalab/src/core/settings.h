/* Everything that can be set, as one array of floats: ids as in PROTOCOL.md. */
#ifndef DL_SETTINGS_H
#define DL_SETTINGS_H

#include <stdint.h>

#define DL_JOINTS 4
#define DL_JOINT_SETTINGS 10
#define DL_GEOMETRY_SIZE 23

enum { DL_KP, DL_KI, DL_KD, DL_N, DL_MIN, DL_MAX, DL_SPEED, DL_OFFSET, DL_SCALE, DL_HOME_JOINT };
enum {
    DL_TOOL_SPEED = 40, DL_HOLD_AFTER, DL_OFF_AFTER, DL_JUMP, DL_FOLLOWING, DL_FOLLOWING_TIME, DL_HOME_SPEED,
    DL_SUPPLY, DL_SERIAL, DL_PEN_UP, DL_PEN_DOWN, DL_STOP_TIME, DL_DUTY_MAX, DL_GEOMETRY,
    DL_SETTINGS = DL_GEOMETRY + DL_GEOMETRY_SIZE
};

#define DL_IMAGE_BYTES (4 * DL_SETTINGS + 2)

/* What a firmware was built for. */
typedef struct {
    uint8_t board;      /* DL_BOARD_... */
    uint8_t robot;      /* DL_ROBOT_... */
    uint8_t drive;      /* DL_DRIVE_... */
    uint16_t period_us; /* of dl_tick */
} dl_build;

/* Number of joints of a robot. */
uint8_t dl_joints(uint8_t robot);
/* A setting of a joint, from 0. */
static inline float dl_joint(const float *settings, uint8_t joint, uint8_t which)
{
    return settings[DL_JOINT_SETTINGS * joint + which];
}

/* The built-in settings; 0 (and nothing but zeros) if this robot is not built with this drive. */
uint8_t dl_defaults(const dl_build *build, float *settings);
/* Takes the stored settings if `stored` (may be NULL) is an image of this build; else `settings` stay as they are.
 * Returns DL_SETTINGS_... */
uint8_t dl_load_settings(const dl_build *build, const uint8_t *stored, float *settings);
/* The CRC at the end of an image; it is that of another build's image only by chance. */
uint16_t dl_image_crc(const dl_build *build, const uint8_t *settings);

/* Whether a setting may be changed while the motors hold, not in OFF only. */
uint8_t dl_is_live(uint8_t id);
/* DL_REFUSED_OK or why this robot's setting `id` cannot have that value. */
uint8_t dl_check_setting(const dl_build *build, const float *settings, uint8_t id, float value);

/* CRC-32 over the geometry. */
uint32_t dl_geometry_hash(const float *settings);

#endif
