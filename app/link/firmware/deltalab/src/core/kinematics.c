#include "kinematics.h"

#include <math.h>

#include "codes.h"
#include "geometry.h"
#include "settings.h"

#define PI 3.14159265f

typedef struct {
    float x, y, z;
} vector;

/* E sin q + F cos q + G = 0 with the elbow outside; NaN where the loop cannot close. See app/robots/rotary_arm.py. */
static float outer_angle(float E, float F, float G)
{
    float root = sqrtf(E * E + F * F - G * G);
    if (E <= 0.0f) return 2.0f * atan2f(G + F, root - E);
    float q = 2.0f * atan2f(-(root + E), G - F);
    if (q > PI) return q - 2.0f * PI;
    return q < -PI ? q + 2.0f * PI : q;
}

/* From the motor's axis to the rod's joint on the platform. */
static vector to_platform(const float *geometry, const float *leg, const float *pose, float s, float c)
{
    return (vector){pose[0] + leg[DL_LEG_X] - leg[DL_LEG_LINK] * s, pose[1] + leg[DL_LEG_Y] + leg[DL_LEG_LINK] * c,
                    pose[2] + geometry[DL_HEIGHT]};
}

static void rotary_inverse(const float *geometry, uint8_t legs, const float *pose, float *joints)
{
    float L = geometry[DL_ARM], l = geometry[DL_ROD];
    float s = legs == 4 ? sinf(pose[3]) : 0.0f, c = legs == 4 ? cosf(pose[3]) : 1.0f;
    for (uint8_t i = 0; i < legs; i++) {
        const float *leg = geometry + DL_LEGS + DL_LEG_SIZE * i;
        vector u = to_platform(geometry, leg, pose, s, c);
        float outward = u.x * leg[DL_LEG_COS] + u.y * leg[DL_LEG_SIN];
        float G = u.x * u.x + u.y * u.y + u.z * u.z + L * L - l * l;
        joints[i] = outer_angle(2.0f * L * u.z, -2.0f * L * outward, G);
    }
}

static void linear_inverse(const float *geometry, const float *pose, float *joints)
{
    for (uint8_t i = 0; i < 3; i++) {
        float x = pose[0] - geometry[DL_RAILS + 2 * i], y = pose[1] - geometry[DL_RAILS + 2 * i + 1];
        joints[i] = -pose[2] - sqrtf(geometry[DL_RAIL_ROD] * geometry[DL_RAIL_ROD] - x * x - y * y);
    }
}

/* An arm points to the tool, turned outwards; -90 to 270 degrees. See app/robots/fivebar_linkage.py. */
static float fivebar_arm(const float *geometry, float side, float dx, float y)
{
    float r2 = dx * dx + y * y, l_p = geometry[DL_PROXIMAL], l_d = geometry[DL_DISTAL];
    float c = r2 + l_p * l_p - l_d * l_d;
    float s = side * sqrtf(4.0f * l_p * l_p * r2 - c * c);
    return 0.5f * PI - atan2f(c * dx - s * y, c * y + s * dx);
}

static void fivebar_inverse(const float *geometry, const float *pose, float *joints)
{
    joints[0] = fivebar_arm(geometry, 1.0f, pose[0] + geometry[DL_HALF_BASE], pose[1]);
    joints[1] = fivebar_arm(geometry, -1.0f, pose[0] - geometry[DL_HALF_BASE], pose[1]);
    joints[2] = pose[3] - geometry[DL_TURN_A_METRE] * pose[2];
    joints[3] = pose[3];
}

uint8_t dl_inverse(uint8_t robot, const float *geometry, const float *pose, float *joints)
{
    uint8_t n = dl_joints(robot);
    if (robot == DL_ROBOT_LINEAR) linear_inverse(geometry, pose, joints);
    else if (robot == DL_ROBOT_FIVEBAR) fivebar_inverse(geometry, pose, joints);
    else rotary_inverse(geometry, n, pose, joints);
    for (uint8_t i = 0; i < n; i++)
        if (!isfinite(joints[i])) return 0;
    return 1;
}
