/* Steppers with step and direction inputs: the steps of each control period are spread evenly over it. */
#ifndef STEPPERS_H
#define STEPPERS_H

#include <stdint.h>

#include "settings.h"

/* One axis: `phase` gains `rate` at every decision, and an overflow is a step. */
typedef struct {
    volatile int32_t made; /* steps */
    int32_t target;
    uint32_t phase, rate;
    int8_t direction;
} step_axis;

/* Aims the axis so that it arrives `decisions` decisions later. Returns whether it now runs forwards. */
uint8_t step_axis_aim(step_axis *axis, int32_t target, uint32_t decisions);
/* One decision: 1 for a step now. */
uint8_t step_axis_decide(step_axis *axis);

void steppers_start(void);
void steppers_read(float made[DL_JOINTS]);
/* Steps to be at; without power the drivers are disabled and no step is made. */
void steppers_write(uint8_t powered, const float target[DL_JOINTS]);
void TIM7_IRQHandler(void);

#endif
