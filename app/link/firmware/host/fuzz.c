/* Feeds the core with noise and with damaged frames, under the sanitizers: fuzz [SEED]. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../deltalab/src/core/bytes.h"
#include "../deltalab/src/core/machine.h"

#define NOISE_BYTES 1000000u
#define FRAMES 100000u

static const dl_build BUILDS[] = {
    {DL_BOARD_HOST, DL_ROBOT_PAR4, DL_DRIVE_DC, 1000},     {DL_BOARD_HOST, DL_ROBOT_DELTA3, DL_DRIVE_SERVO, 5000},
    {DL_BOARD_HOST, DL_ROBOT_DELTA3, DL_DRIVE_DC, 5000},   {DL_BOARD_HOST, DL_ROBOT_LINEAR, DL_DRIVE_STEPPER, 5000},
    {DL_BOARD_HOST, DL_ROBOT_FIVEBAR, DL_DRIVE_DC, 1000},
};
#define BUILD_COUNT (sizeof BUILDS / sizeof BUILDS[0])

typedef struct {
    dl_machine machine;
    dl_outputs out;
    uint32_t now_us;
} board;

static uint32_t random_state = 1;
static uint8_t states_seen; /* bit a state */

static uint32_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 17;
    random_state ^= random_state << 5;
    return random_state;
}

static void check(int holds, const char *what)
{
    if (holds) return;
    fprintf(stderr, "broken: %s\n", what);
    exit(1);
}

static void check_board(const board *b)
{
    const dl_machine *m = &b->machine;
    int powered = m->state != DL_OFF && m->state != DL_FAULT;
    check(m->state <= DL_FAULT, "the state is one of the protocol's");
    states_seen |= (uint8_t)(1 << m->state);
    check(b->out.powered == powered, "power is on in the powered states only");
    check(b->out.laser == 0.0f || m->state == DL_MOVING, "the laser is on in MOVING only");
    for (uint8_t j = 0; j < m->joints; j++) {
        check(isfinite(m->motion.setpoint[j]) && isfinite(b->out.drive[j]), "set-points and outputs are numbers");
        check(m->build.drive != DL_DRIVE_DC || fabsf(b->out.drive[j]) <= 1.0f, "no more than the supply");
    }
}

/* The joints follow at once, sometimes not at all; now and then a switch or the emergency stop. */
static void tick(board *b)
{
    dl_machine *m = &b->machine;
    dl_inputs in = m->inputs;
    for (uint8_t j = 0; j < m->joints && next_random() % 8; j++) {
        float raw = (m->motion.setpoint[j] - dl_joint(m->settings, j, DL_OFFSET)) / dl_joint(m->settings, j, DL_SCALE);
        in.raw[j] = fabsf(raw) < 1e9f ? raw : 0.5f;
    }
    in.limit_switches = next_random() % 64 ? 0 : (uint8_t)next_random();
    in.estop_open = next_random() % 4096 == 0;
    b->now_us += m->build.period_us;
    dl_tick(m, b->now_us, &in, &b->out);
    check_board(b);
    uint8_t frame[DL_FRAME_MAX];
    uint8_t length = dl_transmit(m, frame);
    check(length <= DL_FRAME_MAX && (length == 0 || (frame[0] == 0 && frame[length - 1] == 0)), "frames are whole");
}

static void start(board *b, uint32_t which)
{
    memset(b, 0, sizeof *b);
    check(dl_start(&b->machine, &BUILDS[which], DL_RESET_POWER, 1, NULL), "the build exists");
    for (uint8_t j = 0; j < DL_JOINTS; j++) b->machine.inputs.raw[j] = 0.5f;
    tick(b);
}

static float random_float(void)
{
    static const float ODD[] = {0.0f, -0.0f, 1e-30f, -1e30f, 3e38f, INFINITY, -INFINITY, NAN};
    uint32_t kind = next_random() % 8;
    if (kind == 0) return ODD[next_random() % 8];
    return ((float)(next_random() % 20001) - 10000.0f) * (kind < 5 ? 5e-5f : 1e-2f);
}

/* Often one that is accepted. */
static float random_target(const dl_machine *m, uint8_t joint)
{
    float near = joint < m->joints ? m->motion.setpoint[joint] : 0.0f;
    return next_random() % 2 ? near + 2e-6f * (float)(next_random() % 10001) - 0.01f : random_float();
}

/* A valid payload of any type, its fields at random but often sensible. */
static uint8_t random_payload(const dl_machine *m, uint8_t *at)
{
    static const uint8_t LENGTHS[] = {3, 3, 22, 5, 8, 4, 11};
    uint8_t type = (uint8_t)(next_random() % 7);
    for (uint8_t i = 0; i < DL_PAYLOAD_MAX; i++)
        at[i] = (uint8_t)(next_random() % 5 ? next_random() % 10 : next_random());
    at[0] = (uint8_t)(type + 1);
    if (at[0] == DL_SETPOINT)
        for (uint8_t i = 0; i < 4; i++) dl_put_f32(at + 6 + 4 * i, random_target(m, i));
    if (at[0] == DL_SET) {
        at[3] = (uint8_t)(next_random() % 80);
        dl_put_f32(at + 4, random_float());
    }
    if (at[0] == DL_TEST) {
        at[3] = (uint8_t)(next_random() % 2);
        dl_put_f32(at + 5, 0.1f * random_float());
    }
    return LENGTHS[type];
}

/* A flipped bit, a lost, an added or a doubled byte, a cut; or nothing. */
static uint8_t damage(uint8_t *frame, uint8_t length)
{
    uint8_t at = (uint8_t)(next_random() % length);
    switch (next_random() % 8) {
    case 0: frame[at] ^= (uint8_t)(1 << next_random() % 8); return length;
    case 1: memmove(frame + at, frame + at + 1, (size_t)(length - at - 1)); return (uint8_t)(length - 1);
    case 2: memmove(frame + at + 1, frame + at, (size_t)(length - at)); return (uint8_t)(length + 1);
    case 3: frame[at] = (uint8_t)next_random(); return length;
    case 4: return at;
    default: return length;
    }
}

static void feed(board *b, const uint8_t *bytes, uint8_t count)
{
    for (uint8_t i = 0; i < count; i++) dl_receive(&b->machine, bytes[i]);
    tick(b);
}

static void noise(board *b)
{
    for (uint32_t i = 0; i < NOISE_BYTES / BUILD_COUNT; i++) {
        uint8_t byte = (uint8_t)next_random();
        dl_receive(&b->machine, byte);
        if (i % 16 == 0) tick(b);
    }
}

/* Chance alone would seldom bring it there. */
static void make_ready(board *b)
{
    static const uint8_t COMMANDS[] = {DL_CLEAR, DL_ENABLE};
    dl_defaults(&b->machine.build, b->machine.settings);
    for (uint8_t i = 0; i < sizeof COMMANDS; i++) {
        uint8_t frame[DL_FRAME_MAX] = {0, 0, DL_COMMAND, 0, 0, COMMANDS[i], 0};
        feed(b, frame, dl_encode(frame, 5));
    }
    b->machine.homed = 1;
}

static void damaged_frames(board *b)
{
    for (uint32_t i = 0; i < FRAMES / BUILD_COUNT; i++) {
        uint8_t frame[DL_FRAME_MAX + 1];
        uint8_t length = dl_encode(frame, random_payload(&b->machine, frame + DL_FRAME_HEAD));
        if (i % 64 == 0) make_ready(b);
        feed(b, frame, damage(frame, length));
        for (uint32_t silent = next_random() % 64 ? 0 : next_random() % 200; silent > 0; silent--) tick(b);
    }
}

int main(int count, char **arguments)
{
    static board boards[BUILD_COUNT];
    uint32_t good = 0;
    random_state = count > 1 ? (uint32_t)strtoul(arguments[1], NULL, 10) * 2654435761u | 1u : 1u;
    for (uint32_t k = 0; k < BUILD_COUNT; k++) {
        start(&boards[k], k);
        noise(&boards[k]);
        damaged_frames(&boards[k]);
        good += boards[k].machine.good;
    }

    check(states_seen == 0xFF, "the frames led through every state");
    printf("%u noise bytes, %u frames, %u good ones\n", NOISE_BYTES, FRAMES, good);
    return 0;
}
