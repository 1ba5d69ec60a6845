/* Frames on the wire: 00 | COBS(payload, CRC) | 00. */
#ifndef DL_FRAME_H
#define DL_FRAME_H

#include <stdint.h>

#define DL_PAYLOAD_MIN 3
#define DL_PAYLOAD_MAX 56
#define DL_CRC_BYTES 2
#define DL_FRAME_HEAD 2 /* the leading 00 and the first COBS code */
#define DL_FRAME_MAX (DL_FRAME_HEAD + DL_PAYLOAD_MAX + DL_CRC_BYTES + 1)

typedef struct {
    uint8_t data[DL_PAYLOAD_MAX + DL_CRC_BYTES]; /* of the frame that comes, zeros put back */
    uint8_t length;                              /* of it; DL_DECODER_FULL once it cannot be a frame any more */
    uint8_t block_left;                          /* bytes until the next COBS code */
    uint8_t begun;                               /* whether anything came since the last border */
    uint16_t crc;                                /* of all of data; 0 at the end of a good frame */
} dl_decoder;

/* CRC-16/CCITT-FALSE, one byte further; it starts at FFFF. */
uint16_t dl_crc16(uint16_t crc, uint8_t byte);

void dl_decoder_reset(dl_decoder *d);
/* Takes one byte: the length of the payload in d->data if a good frame ends here, -1 if a bad one does, else 0. */
int8_t dl_decode(dl_decoder *d, uint8_t byte);
/* Makes a frame of the payload that lies at frame + DL_FRAME_HEAD; returns the number of bytes to send. */
uint8_t dl_encode(uint8_t *frame, uint8_t length);

#endif
