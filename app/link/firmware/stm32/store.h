/* Settings that outlast a power cut, in one sector of the flash memory. */
#ifndef STORE_H
#define STORE_H

#include "machine.h"

/* The image that was stored last, as dl_start takes it; NULL if there never was one. */
const uint8_t *store_read(void);
/* Takes up to a second, in which nothing else runs: to be called with the motors off only. */
void store_write(const dl_machine *machine);

#endif
