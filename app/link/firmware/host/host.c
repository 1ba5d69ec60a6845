/* The core as a shared library, with calls that a foreign function interface finds easy. dl_inverse, dl_forward_step
 * and dl_pid_step are exported as they are. */
#include <stdlib.h>
#include <string.h>

#include "../deltalab/src/core/kinematics.h"
#include "../deltalab/src/core/machine.h"

dl_machine *dlh_new(void)
{
    return calloc(1, sizeof(dl_machine));
}

void dlh_free(dl_machine *m)
{
    free(m);
}

/* 0 if there is no such build. */
int dlh_start(dl_machine *m, int robot, int drive, int board, int period_us, uint32_t serial, int reset,
              const uint8_t *stored)
{
    dl_build build = {(uint8_t)board, (uint8_t)robot, (uint8_t)drive, (uint16_t)period_us};
    return dl_start(m, &build, (uint8_t)reset, serial, stored);
}

void dlh_receive(dl_machine *m, const uint8_t *bytes, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) dl_receive(m, bytes[i]);
}

/* `raw`: 4 floats; `out`: 7 floats: powered, the drives, the pen's pulse, the laser. */
void dlh_tick(dl_machine *m, uint32_t now_us, const float *raw, int limit_switches, int estop_open, float *out)
{
    dl_inputs in = {{0}, (uint8_t)limit_switches, (uint8_t)(estop_open != 0), 0};
    dl_outputs outputs;
    memcpy(in.raw, raw, sizeof in.raw);
    dl_tick(m, now_us, &in, &outputs);
    out[0] = outputs.powered;
    memcpy(out + 1, outputs.drive, sizeof outputs.drive);
    out[5] = outputs.pen_us;
    out[6] = outputs.laser;
}

/* Every frame that waits, one after the other, as far as they fit; the number of bytes. */
uint32_t dlh_transmit(dl_machine *m, uint8_t *bytes, uint32_t room)
{
    uint32_t count = 0;
    while (room - count >= DL_FRAME_MAX) {
        uint8_t length = dl_transmit(m, bytes + count);
        if (length == 0) break;
        count += length;
    }
    return count;
}

/* DL_IMAGE_BYTES of it. */
void dlh_image(const dl_machine *m, uint8_t *image)
{
    for (uint16_t i = 0; i < DL_IMAGE_BYTES; i++) image[i] = dl_image_byte(m, i);
}

int dlh_take_save_request(dl_machine *m)
{
    return dl_take_save_request(m);
}

/* Payload of 3 to 56 bytes in, frame out; `frame` has room for DL_FRAME_MAX. */
uint32_t dlh_encode(const uint8_t *payload, uint32_t length, uint8_t *frame)
{
    memcpy(frame + DL_FRAME_HEAD, payload, length);
    return dl_encode(frame, (uint8_t)length);
}

/* Good frames in a stream: each as its length and its payload; `payloads` has room for 58 bytes per 7 of the stream. */
uint32_t dlh_decode(const uint8_t *bytes, uint32_t count, uint8_t *payloads, uint32_t *bad)
{
    dl_decoder decoder;
    uint32_t used = 0;
    *bad = 0;
    dl_decoder_reset(&decoder);
    for (uint32_t i = 0; i < count; i++) {
        int8_t length = dl_decode(&decoder, bytes[i]);
        *bad += length < 0;
        if (length <= 0) continue;
        payloads[used++] = (uint8_t)length;
        memcpy(payloads + used, decoder.data, (size_t)length);
        used += (uint32_t)length;
    }
    return used;
}

uint32_t dlh_machine_bytes(void)
{
    return sizeof(dl_machine);
}
