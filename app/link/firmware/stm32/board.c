#include "board.h"

#include "bridges.h"
#include "build.h"
#include "gpio.h"
#include "sensors.h"
#include "steppers.h"
#include "pen_laser.h"

static uint8_t has_steppers(void) { return board_build.drive == DL_DRIVE_STEPPER; }

void board_start(void)
{
    pin_output(PIN_POWER);
    pin_output(PIN_LAMP);
    pin_pullup(PIN_ESTOP);
    pin_alternate(PIN_ESTOP, AF_TIM1); /* still readable as an input */
    for (uint8_t j = 0; j < DL_JOINTS; j++) pin_input_pullup(PIN_SWITCH(j));
    if (has_steppers()) {
        steppers_start();
    } else {
        sensors_start();
        bridges_start();
    }
    pen_laser_start();
}

void board_read(dl_inputs *in)
{
    if (has_steppers())
        steppers_read(in->raw);
    else
        sensors_read(in->raw);
    in->limit_switches = 0;
    for (uint8_t j = 0; j < DL_JOINTS; j++) in->limit_switches |= (uint8_t)(!pin_read(PIN_SWITCH(j)) << j);
    in->estop_open = pin_read(PIN_ESTOP);
}

void board_write(const dl_outputs *out)
{
    if (has_steppers())
        steppers_write(out->powered, out->drive);
    else
        bridges_write(out->powered, out->drive);
    pin_write(PIN_POWER, out->powered);
    pin_write(PIN_LAMP, out->powered);
    pen_laser_write(out->pen_us, out->laser);
}

void board_off(void)
{
    const dl_outputs off = {0};
    board_write(&off);
}
