/* Where the tool is at the set-point, which bounds its speed in manual mode. */
#ifndef DL_TOOL_H
#define DL_TOOL_H

#include <stdint.h>

#include "motion.h"

typedef struct {
    float pose[4]; /* at the set-point, if known; else where Newton's method has come so far */
    float velocity[4]; /* in manual mode, per second */
    float look_left;   /* s for which that velocity holds */
    uint8_t known;
} dl_tool;

/* The set-point is somewhere else now. */
void dl_tool_lose(dl_tool *tool, const dl_build *build, const float *settings, const float *joints);
/* At rest: one step nearer to the pose, until it is known. */
void dl_tool_settle(dl_tool *tool, const dl_build *build, const float *settings, const dl_motion *motion);
/* The motion has another target. */
void dl_tool_look_again(dl_tool *tool);
/* Before the motion goes on by `dt` seconds in manual mode: makes it so slow that the tool keeps its limit. Where the
 * pose is not known, or must not be trusted (not homed), no joint is faster than in homing. */
void dl_tool_limit(dl_tool *tool, const dl_build *build, const float *settings, dl_motion *motion, uint8_t homed,
                   float dt);

#endif
