/* Where the joints must be for a pose, and where the tool is for a set of joints. Geometry: see PROTOCOL.md. */
#ifndef DL_KINEMATICS_H
#define DL_KINEMATICS_H

#include <stdint.h>

/* Joints of a pose (x, y, z and a turn, unused ones 0). 0 if some loop cannot close; joint limits are not applied. */
uint8_t dl_inverse(uint8_t robot, const float *geometry, const float *pose, float *joints);

/* A pose somewhere in the middle, from which Newton's method finds the assembly that the machine is in. */
void dl_forward_guess(uint8_t robot, const float *geometry, const float *joints, float *pose);
/* One step of Newton's method from `pose` towards the pose of these joints: how far it went, in m and rad together;
 * -1 at a singularity, where x and y stay (and z, unless it is the 5R robot's). */
float dl_forward_step(uint8_t robot, const float *geometry, const float *joints, float *pose);

#endif
