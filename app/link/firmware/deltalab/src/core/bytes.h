/* Little endian numbers in a row of bytes. Every processor that we build for is little endian itself. */
#ifndef DL_BYTES_H
#define DL_BYTES_H

#include <stdint.h>
#include <string.h>

static inline uint8_t *dl_put_u8(uint8_t *at, uint8_t value)
{
    *at = value;
    return at + 1;
}

static inline uint8_t *dl_put_u16(uint8_t *at, uint16_t value)
{
    memcpy(at, &value, sizeof value);
    return at + sizeof value;
}

static inline uint8_t *dl_put_u32(uint8_t *at, uint32_t value)
{
    memcpy(at, &value, sizeof value);
    return at + sizeof value;
}

static inline uint8_t *dl_put_f32(uint8_t *at, float value)
{
    memcpy(at, &value, sizeof value);
    return at + sizeof value;
}

static inline uint16_t dl_get_u16(const uint8_t *at)
{
    uint16_t value;
    memcpy(&value, at, sizeof value);
    return value;
}

static inline float dl_get_f32(const uint8_t *at)
{
    float value;
    memcpy(&value, at, sizeof value);
    return value;
}

#endif
