/* Settings in the EEPROM: written a byte a pass, since each takes 3.4 ms to burn. */
#ifndef DL_STORAGE_H
#define DL_STORAGE_H

#include <avr/eeprom.h>

#include "src/core/machine.h"

/* Goes on with a save that was granted, without ever waiting.
 *
 * A SET in the meantime changes the image, so it goes round until a whole round found nothing to write. */
static void continue_saving() {
    static uint16_t next = DL_IMAGE_BYTES;
    static bool written;
    if (dl_take_save_request(&machine)) {
        next = 0;
        written = false;
    }
    if (next == DL_IMAGE_BYTES || !eeprom_is_ready()) return;
    uint8_t byte = dl_image_byte(&machine, next);
    uint8_t *cell = (uint8_t *)next;
    if (eeprom_read_byte(cell) != byte) {
        eeprom_write_byte(cell, byte);
        written = true;
    }
    if (++next == DL_IMAGE_BYTES && written) {
        next = 0;
        written = false;
    }
}

#endif
