#include "frame.h"

#define DL_DECODER_FULL 0xFF

uint16_t dl_crc16(uint16_t crc, uint8_t byte)
{
    /* The CCITT polynomial without a table: 8 shifts at once. */
    uint8_t x = (uint8_t)((crc >> 8) ^ byte);
    x ^= x >> 4;
    return (uint16_t)((crc << 8) ^ ((uint16_t)x << 12) ^ ((uint16_t)x << 5) ^ x);
}

void dl_decoder_reset(dl_decoder *d)
{
    d->length = 0;
    d->block_left = 0;
    d->begun = 0;
    d->crc = 0xFFFF;
}

static void append(dl_decoder *d, uint8_t byte)
{
    if (d->length >= sizeof d->data) {
        d->length = DL_DECODER_FULL;
        return;
    }
    d->data[d->length++] = byte;
    d->crc = dl_crc16(d->crc, byte);
}

static int8_t finish(const dl_decoder *d)
{
    uint8_t whole = d->block_left == 0 && d->length != DL_DECODER_FULL;
    /* A CRC over what it protects and itself is 0. */
    if (!whole || d->length < DL_PAYLOAD_MIN + DL_CRC_BYTES || d->crc != 0) return -1;
    return (int8_t)(d->length - DL_CRC_BYTES);
}

int8_t dl_decode(dl_decoder *d, uint8_t byte)
{
    if (byte == 0) {
        int8_t length = d->begun ? finish(d) : 0;
        dl_decoder_reset(d);
        return length;
    }
    if (d->block_left > 0) {
        append(d, byte);
        d->block_left--;
        return 0;
    }
    /* A code: its block is so long, and a zero lies between two blocks. */
    if (d->begun) append(d, 0);
    d->begun = 1;
    d->block_left = (uint8_t)(byte - 1);
    return 0;
}

uint8_t dl_encode(uint8_t *frame, uint8_t length)
{
    uint8_t *at = frame + DL_FRAME_HEAD;
    uint16_t crc = 0xFFFF;
    for (uint8_t i = 0; i < length; i++) crc = dl_crc16(crc, at[i]);
    at[length] = (uint8_t)(crc >> 8);
    at[length + 1] = (uint8_t)crc;

    uint8_t end = (uint8_t)(DL_FRAME_HEAD + length + DL_CRC_BYTES);
    uint8_t code = 1; /* where the code of the present block lies; it is the distance to the next zero */
    for (uint8_t i = DL_FRAME_HEAD; i < end; i++) {
        if (frame[i] != 0) continue;
        frame[code] = (uint8_t)(i - code);
        code = i;
    }
    frame[code] = (uint8_t)(end - code);
    frame[0] = 0;
    frame[end] = 0;
    return (uint8_t)(end + 1);
}
