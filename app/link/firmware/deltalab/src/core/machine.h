/* The board's behaviour, the same on every board: PROTOCOL.md says what it does.
 *
 * A board calls dl_start once, dl_receive for each byte that came, dl_tick once a control period, and sends the bytes
 * that dl_transmit fills in, whenever it has room for a whole frame. Nothing here blocks, allocates or knows a
 * register. All of it is to be called from one context: none of it from an interrupt, or all of it.
 */
#ifndef DL_MACHINE_H
#define DL_MACHINE_H

#include <stdint.h>

#include "codes.h"
#include "frame.h"
#include "motion.h"
#include "pid.h"
#include "settings.h"
#include "tool.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    float raw[DL_JOINTS];    /* potentiometer 0..1, or steps made; ignored for servos */
    uint8_t limit_switches;  /* bit a joint, 1 closed */
    uint8_t estop_open;      /* 1: pressed, or its wire broken */
    uint8_t load;            /* percent of the processor in use */
} dl_inputs;

typedef struct {
    uint8_t powered;
    float drive[DL_JOINTS];  /* DC: share of the supply -1..1; servo: pulse in us; stepper: steps to be at */
    float pen_us;            /* pulse of the pen's servo */
    float laser;             /* 0..1 */
} dl_outputs;

#define DL_ACKS 4

typedef struct {
    uint16_t number;
    uint8_t result;
    float value;
} dl_ack;

/* What waits to be sent. */
typedef struct {
    dl_ack acks[DL_ACKS];
    uint8_t ack_count;
    uint8_t identity, telemetry, sample; /* 1: waits */
    uint16_t identity_number;
    uint32_t telemetry_us, sample_us;    /* when the last one was due */
} dl_reports;

typedef struct {
    uint8_t kind, joint;
    uint16_t number;      /* of the frame that asked for it */
    float amplitude;      /* share of the supply, or rad */
    uint32_t duration_us;
} dl_test;

typedef struct {
    dl_build build;
    uint8_t joints;
    float settings[DL_SETTINGS];
    uint8_t settings_source; /* DL_SETTINGS_... */
    uint8_t reset;
    uint8_t save_requested;
    uint32_t serial;         /* 0: the one in the settings */
    uint32_t geometry;       /* hash */

    uint8_t state, fault, fault_joint, refusal;
    uint8_t homed, manual, pen_down, laser;
    uint8_t ticked;             /* whether the inputs are known yet */
    uint16_t setpoint_number;   /* of the last accepted one */
    uint32_t now_us;            /* of the last tick */
    uint32_t frame_us;          /* when the last good frame came */
    uint32_t setpoint_us;       /* when the last set-point was accepted */
    uint32_t state_us;          /* when homing, its second half, or a test began */
    uint32_t settled_us;        /* for so long at the target or at home */
    uint32_t following_us[DL_JOINTS]; /* for so long too far from the set-point */

    dl_inputs inputs;
    float position[DL_JOINTS];  /* rad or m; a servo's is its set-point */
    float origin[DL_JOINTS];    /* steppers: raw where the joint is at `offset` */
    float drive[DL_JOINTS];     /* DC: share of the supply */
    uint8_t found;              /* homing: bit a joint whose switch closed */
    dl_motion motion;
    dl_tool tool;
    dl_pid pid[DL_JOINTS];
    dl_test test;

    dl_decoder decoder;
    uint16_t good, bad;         /* frames */
    dl_reports reports;
} dl_machine;

/* `stored` is an image of DL_IMAGE_BYTES as dl_image_byte gave it, or memory never written, or NULL. 0 if there is no
 * such build: then the machine must not be used. */
uint8_t dl_start(dl_machine *m, const dl_build *build, uint8_t reset, uint32_t serial, const uint8_t *stored);
void dl_receive(dl_machine *m, uint8_t byte);
void dl_tick(dl_machine *m, uint32_t now_us, const dl_inputs *in, dl_outputs *out);
/* The next frame to send, delimiters included; 0 if there is none. `frame` has room for DL_FRAME_MAX bytes. */
uint8_t dl_transmit(dl_machine *m, uint8_t *frame);
/* After a SAVE: byte `i` of the image to write to permanent memory, DL_IMAGE_BYTES in all. */
uint8_t dl_image_byte(const dl_machine *m, uint16_t i);
/* 1 once after each SAVE that was granted. */
uint8_t dl_take_save_request(dl_machine *m);

#ifdef __cplusplus
}
#endif
#endif
