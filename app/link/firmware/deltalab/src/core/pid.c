#include "pid.h"

#include "settings.h"

/* kd n s / (s + n), or kd s where n is 0. */
static float derivative(const dl_pid *pid, const float *gains, float h, float change)
{
    if (gains[DL_KD] == 0.0f) return 0.0f;
    if (gains[DL_N] == 0.0f) return gains[DL_KD] * change / h;
    float keep = 1.0f / (1.0f + gains[DL_N] * h);
    return keep * (pid->derivative + gains[DL_KD] * gains[DL_N] * change);
}

float dl_pid_step(dl_pid *pid, const float *gains, float h, float error, float limit)
{
    float growth = gains[DL_KI] * h * error;
    pid->derivative = derivative(pid, gains, h, error - pid->last_error);
    pid->last_error = error;
    float wanted = gains[DL_KP] * error + pid->integral + growth + pid->derivative;
    if (wanted >= -limit && wanted <= limit) {
        pid->integral += growth;
        return wanted;
    }
    /* The integral may only lead back from the limit. */
    if (!(growth * wanted > 0.0f)) pid->integral += growth;
    return wanted > 0.0f ? limit : -limit;
}
