#include "panel.h"

#include <math.h>

#include "display.h"
#include "gpio.h"
#include "kinematics.h"

#define DEGREES 57.29578f
#define MILLIMETRES 1000.0f
#define NEAR 0.01f /* m or rad: steps of Newton's method shorter than this are close to the pose */

enum { WIRES = 6, TURN = 3 };
static const uint8_t pins[WIRES] = { /* in the order of the bits of display_step */
    PIN_DISPLAY_DATA(0), PIN_DISPLAY_DATA(1), PIN_DISPLAY_DATA(2), PIN_DISPLAY_DATA(3), PIN_DISPLAY_RS, PIN_DISPLAY_E,
};

static const dl_machine *shown;
static float pose[DL_JOINTS]; /* where the tool is by the measured joints, one step of Newton's method a millisecond */
static float last_step = -1.0f;

static void follow_pose(void)
{
    const float *geometry = shown->settings + DL_GEOMETRY;
    if (last_step < 0.0f) dl_forward_guess(shown->build.robot, geometry, shown->position, pose);
    last_step = dl_forward_step(shown->build.robot, geometry, shown->position, pose);
}

static void write_row(uint8_t row, char text[DISPLAY_COLUMNS])
{
    const float unit = shown->build.robot == DL_ROBOT_LINEAR ? MILLIMETRES : DEGREES;
    const uint8_t known = last_step >= 0.0f && last_step < NEAR && (row < TURN || shown->joints > TURN);
    const float coordinate = known ? pose[row] * (row < TURN ? MILLIMETRES : DEGREES) : NAN;
    const uint8_t there = row < shown->joints;
    const float q = there ? unit * shown->motion.setpoint[row] : NAN;
    display_row(text, row, q, there ? unit * shown->position[row] : NAN, coordinate);
}

void panel_start(void)
{
    for (uint8_t i = 0; i < WIRES; i++) pin_output(pins[i]);
}

void panel_step(const dl_machine *machine)
{
    static display state;
    shown = machine;
    follow_pose();
    const uint8_t wires = display_step(&state, write_row);
    for (uint8_t i = 0; i < WIRES; i++) pin_write(pins[i], wires >> i & 1);
}

