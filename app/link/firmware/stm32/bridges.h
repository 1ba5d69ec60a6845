/* Four DC motors through H-bridges of the kind VNH5019: a PWM input of 20 kHz and two direction inputs each. */
#ifndef BRIDGES_H
#define BRIDGES_H

#include <stdint.h>

#include "settings.h"

void bridges_start(void);
/* Shares of the supply, -1..1; without power every input is low, and the motors coast. */
void bridges_write(uint8_t powered, const float drive[DL_JOINTS]);

#endif
