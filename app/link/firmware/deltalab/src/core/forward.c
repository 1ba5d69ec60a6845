/* Forward kinematics by Newton's method on |rod|^2 = l^2, one equation a rod. */
#include <math.h>

#include "codes.h"
#include "geometry.h"
#include "kinematics.h"
#include "settings.h"

#define STEP_MAX 0.1f /* m or rad: from the middle it then cannot jump to another assembly */

typedef float row[DL_JOINTS + 1]; /* an equation: coefficients, then the right hand side */

/* The equation of a rod: it points to (x, y, z) and should be `length` long; `turning` is its change with the turn. */
static void rod_equation(float *equation, uint8_t n, float x, float y, float z, float turning, float length)
{
    float rod[3] = {x, y, z};
    for (uint8_t i = 0; i < n && i < 3; i++) equation[i] = rod[i];
    if (n == 4) equation[3] = turning;
    equation[n] = 0.5f * (length * length - x * x - y * y - z * z);
}

static void rotary_equations(const float *geometry, uint8_t n, const float *joints, const float *pose, row *rows)
{
    float s = n == 4 ? sinf(pose[3]) : 0.0f, c = n == 4 ? cosf(pose[3]) : 1.0f;
    for (uint8_t i = 0; i < n; i++) {
        const float *leg = geometry + DL_LEGS + DL_LEG_SIZE * i;
        float out = geometry[DL_ARM] * cosf(joints[i]), up = geometry[DL_ARM] * sinf(joints[i]);
        float link = leg[DL_LEG_LINK];
        float x = pose[0] + leg[DL_LEG_X] - link * s - out * leg[DL_LEG_COS];
        float y = pose[1] + leg[DL_LEG_Y] + link * c - out * leg[DL_LEG_SIN];
        float z = pose[2] + geometry[DL_HEIGHT] + up;
        rod_equation(rows[i], n, x, y, z, -link * (x * c + y * s), geometry[DL_ROD]);
    }
}

static void linear_equations(const float *geometry, const float *joints, const float *pose, row *rows)
{
    for (uint8_t i = 0; i < 3; i++) {
        const float *rail = geometry + DL_RAILS + 2 * i;
        float x = pose[0] - rail[0], y = pose[1] - rail[1], z = pose[2] + joints[i];
        rod_equation(rows[i], 3, x, y, z, 0.0f, geometry[DL_RAIL_ROD]);
    }
}

static void fivebar_equations(const float *geometry, const float *joints, const float *pose, row *rows)
{
    for (uint8_t i = 0; i < 2; i++) {
        float motor = i ? geometry[DL_HALF_BASE] : -geometry[DL_HALF_BASE];
        float x = pose[0] - motor - geometry[DL_PROXIMAL] * cosf(joints[i]);
        float y = pose[1] - geometry[DL_PROXIMAL] * sinf(joints[i]);
        rod_equation(rows[i], 2, x, y, 0.0f, 0.0f, geometry[DL_DISTAL]);
    }
}

static void swap_rows(float *a, float *b, uint8_t length)
{
    for (uint8_t i = 0; i < length; i++) {
        float kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

static void eliminate(float *equation, const float *pivot, uint8_t k, uint8_t n)
{
    float factor = equation[k] / pivot[k];
    for (uint8_t j = k; j <= n; j++) equation[j] -= factor * pivot[j];
}

/* Gauss with pivots; the solution is left in the last column. 0 where the rows do not determine it. */
static uint8_t solve(row *rows, uint8_t n)
{
    for (uint8_t k = 0; k < n; k++) {
        uint8_t best = k;
        for (uint8_t i = k + 1; i < n; i++)
            if (fabsf(rows[i][k]) > fabsf(rows[best][k])) best = i;
        if (!(fabsf(rows[best][k]) > 1e-6f)) return 0;
        swap_rows(rows[k], rows[best], n + 1);
        for (uint8_t i = 0; i < n; i++)
            if (i != k) eliminate(rows[i], rows[k], k, n);
    }
    for (uint8_t k = 0; k < n; k++) rows[k][n] /= rows[k][k];
    return 1;
}

/* One step of `n` unknowns, shortened to STEP_MAX. */
static float take_step(row *rows, uint8_t n, float *pose)
{
    if (!solve(rows, n)) return -1.0f;
    float longest = 0.0f;
    for (uint8_t i = 0; i < n; i++) longest = fmaxf(longest, fabsf(rows[i][n]));
    if (!isfinite(longest)) return -1.0f;
    float share = longest > STEP_MAX ? STEP_MAX / longest : 1.0f;
    for (uint8_t i = 0; i < n; i++) pose[i] += share * rows[i][n];
    return share * longest;
}

float dl_forward_step(uint8_t robot, const float *geometry, const float *joints, float *pose)
{
    row rows[DL_JOINTS];
    uint8_t n = robot == DL_ROBOT_FIVEBAR ? 2 : dl_joints(robot);
    if (robot == DL_ROBOT_LINEAR) linear_equations(geometry, joints, pose, rows);
    else if (robot == DL_ROBOT_FIVEBAR) fivebar_equations(geometry, joints, pose, rows);
    else rotary_equations(geometry, n, joints, pose, rows);
    if (robot == DL_ROBOT_FIVEBAR) { /* screw and spline are solved at once */
        pose[2] = (joints[3] - joints[2]) / geometry[DL_TURN_A_METRE];
        pose[3] = joints[3];
    }
    return take_step(rows, n, pose);
}

void dl_forward_guess(uint8_t robot, const float *geometry, const float *joints, float *pose)
{
    pose[0] = pose[1] = pose[2] = pose[3] = 0.0f;
    if (robot == DL_ROBOT_LINEAR) {
        pose[2] = -0.8f * geometry[DL_RAIL_ROD] - (joints[0] + joints[1] + joints[2]) / 3.0f;
    } else if (robot == DL_ROBOT_FIVEBAR) {
        float c = cosf(joints[0]) + cosf(joints[1]), s = sinf(joints[0]) + sinf(joints[1]);
        pose[0] = 0.5f * geometry[DL_PROXIMAL] * c;
        pose[1] = 0.5f * geometry[DL_PROXIMAL] * s + 0.7f * geometry[DL_DISTAL];
    } else {
        pose[2] = -geometry[DL_HEIGHT] - 0.8f * geometry[DL_ROD];
    }
}
