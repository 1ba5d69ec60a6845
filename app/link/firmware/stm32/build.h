/* What this firmware was built for; the only thing in which the variants differ. */
#ifndef BUILD_H
#define BUILD_H

#include "settings.h"

extern const dl_build board_build;
extern const uint8_t board_has_display;

#endif
