/* The text display on its pins. */
#ifndef PANEL_H
#define PANEL_H

#include "machine.h"

void panel_start(void);
/* To be called once a millisecond. */
void panel_step(const dl_machine *machine);

#endif
