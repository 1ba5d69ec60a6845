#include "tool.h"

#include <math.h>
#include <string.h>

#include "codes.h"
#include "kinematics.h"

#define SETTLED 1e-5f /* m or rad */
/* Newton's method takes a small board 2 ms. It looks as far ahead as its velocity will hold: what it corrects of the
 * pose is then added once; over a shorter way it would be added many times, and the pose would run away. */
#define LOOK_S 0.01f
#define PROBE 0.05f /* rad or m: so far ahead the tool goes in a straight line */

void dl_tool_lose(dl_tool *tool, const dl_build *build, const float *settings, const float *joints)
{
    dl_forward_guess(build->robot, settings + DL_GEOMETRY, joints, tool->pose);
    tool->known = 0;
}

void dl_tool_settle(dl_tool *tool, const dl_build *build, const float *settings, const dl_motion *motion)
{
    if (tool->known) return;
    float step = dl_forward_step(build->robot, settings + DL_GEOMETRY, motion->setpoint, tool->pose);
    tool->known = step >= 0.0f && step < SETTLED;
    if (step < 0.0f) dl_tool_lose(tool, build, settings, motion->setpoint);
}

static void go_slowly(const float *settings, dl_motion *motion)
{
    for (uint8_t j = 0; j < DL_JOINTS; j++) {
        float speed = settings[DL_HOME_SPEED] * dl_joint(settings, j, DL_SPEED);
        float way = fabsf(motion->target[j] - motion->setpoint[j]);
        if (speed > 0.0f) motion->time_left = fmaxf(motion->time_left, way / speed);
    }
}

/* The share of what is left of the way that is safe to look ahead. Screw and spline of the 5R robot go straight. */
static float probe_share(const dl_build *build, const dl_motion *motion, float share)
{
    float farthest = 0.0f;
    uint8_t curved = build->robot == DL_ROBOT_FIVEBAR ? 2 : DL_JOINTS;
    for (uint8_t j = 0; j < curved; j++)
        farthest = fmaxf(farthest, fabsf(motion->target[j] - motion->setpoint[j]));
    return farthest * share > PROBE ? PROBE / farthest : share;
}

/* The pose after `probe` of what is left; 0 at a singularity. */
static uint8_t look_ahead(const dl_tool *tool, const dl_build *build, const float *settings, const dl_motion *motion,
                          float probe, float *ahead)
{
    float joints[DL_JOINTS];
    for (uint8_t j = 0; j < DL_JOINTS; j++)
        joints[j] = motion->setpoint[j] + probe * (motion->target[j] - motion->setpoint[j]);
    memcpy(ahead, tool->pose, sizeof tool->pose);
    return dl_forward_step(build->robot, settings + DL_GEOMETRY, joints, ahead) >= 0.0f;
}

/* From the pose after `probe` of the way: the tool's velocity, and the time that the way takes at its limit. */
static void take_velocity(dl_tool *tool, const float *settings, dl_motion *motion, float probe, const float *ahead)
{
    float probe_time = probe * motion->time_left;
    for (uint8_t i = 0; i < 4; i++) tool->velocity[i] = (ahead[i] - tool->pose[i]) / probe_time;
    const float *v = tool->velocity;
    float speed = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    float excess = speed / settings[DL_TOOL_SPEED];
    if (!(excess > 1.0f)) return;
    motion->time_left *= excess;
    for (uint8_t i = 0; i < 4; i++) tool->velocity[i] /= excess;
}

void dl_tool_look_again(dl_tool *tool)
{
    tool->look_left = 0.0f;
}

void dl_tool_limit(dl_tool *tool, const dl_build *build, const float *settings, dl_motion *motion, uint8_t homed,
                   float dt)
{
    if (tool->known && tool->look_left <= 0.0f) {
        float ahead[4], probe = probe_share(build, motion, fminf(fmaxf(LOOK_S, dt) / motion->time_left, 1.0f));
        tool->known = homed && look_ahead(tool, build, settings, motion, probe, ahead);
        if (tool->known) take_velocity(tool, settings, motion, probe, ahead);
        tool->look_left = LOOK_S;
    }
    if (!tool->known) {
        go_slowly(settings, motion);
        return;
    }
    float step = fminf(dt, motion->time_left);
    for (uint8_t i = 0; i < 4; i++) tool->pose[i] += step * tool->velocity[i];
    tool->look_left -= dt;
}
