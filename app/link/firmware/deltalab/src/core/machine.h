/* The board's behaviour, the same on every board: PROTOCOL.md says what it does.
 *
 * A board calls dl_start once, dl_receive for each byte that came, dl_tick once a control period, and sends the bytes
 * that dl_transmit fills in, whenever it has room for a whole frame. Nothing here blocks, allocates or knows a register.
 */
#ifndef DL_MACHINE_H
#define DL_MACHINE_H

#include <stdint.h>

#include "frame.h"
#include "motion.h"
#include "pid.h"
#include "settings.h"
#include "codes.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What a firmware was built for. */
typedef struct {
    uint8_t board;      /* DL_BOARD_... */
    uint8_t robot;      /* DL_ROBOT_... */
    uint8_t drive;      /* DL_DRIVE_... */
    uint16_t period_us; /* of dl_tick */
} dl_build;

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

typedef struct dl_machine dl_machine;

/* `stored` are DL_SETTINGS floats and their CRC as dl_save_image gave them, or NULL. */
void dl_start(dl_machine *m, const dl_build *build, uint8_t reset, uint32_t serial, const uint8_t *stored);
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
