/* A PID controller as app/control/sampled_pid.py has it: backward Euler, filtered derivative, clamping. */
#ifndef DL_PID_H
#define DL_PID_H

typedef struct {
    float integral, derivative, last_error;
} dl_pid;

/* One period of `h` seconds. `gains` are kp, ki, kd and n; the output is within +-limit. */
float dl_pid_step(dl_pid *pid, const float *gains, float h, float error, float limit);

#endif
