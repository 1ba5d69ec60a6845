/* The potentiometers, on four channels of the converter. */
#ifndef SENSORS_H
#define SENSORS_H

#include "settings.h"

void sensors_start(void);
/* Shares of the full turn, 0..1. A converter that does not answer reads 0: a broken wire to the machine. */
void sensors_read(float raw[DL_JOINTS]);

#endif
