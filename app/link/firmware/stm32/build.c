#include "build.h"

#include "codes.h"

#ifndef DL_DISPLAY
#define DL_DISPLAY 1
#endif

#define PERIOD_US 1000

#if defined DL_BUILD_FIVEBAR_DC
const dl_build board_build = {DL_BOARD_STM32F407, DL_ROBOT_FIVEBAR, DL_DRIVE_DC, PERIOD_US};
#elif defined DL_BUILD_LINEAR_STEPPER
const dl_build board_build = {DL_BOARD_STM32F407, DL_ROBOT_LINEAR, DL_DRIVE_STEPPER, PERIOD_US};
#else
const dl_build board_build = {DL_BOARD_STM32F407, DL_ROBOT_PAR4, DL_DRIVE_DC, PERIOD_US};
#endif

const uint8_t board_has_display = DL_DISPLAY;
