/* The STM32F407's firmware: bytes to the machine of the core, a control period every millisecond, bytes back. */
#include "board.h"
#include "build.h"
#include "chip.h"
#include "emulator.h"
#include "panel.h"
#include "stm32f4.h"
#include "store.h"
#include "usart.h"

enum { LATE_PERIODS = 20, LOAD_WINDOW_US = 100000 };

static dl_machine machine;
static uint32_t next_tick_us;
static uint8_t load_percent;

static void tick(uint32_t at_us)
{
    dl_inputs in = {.load = load_percent};
    dl_outputs out;
    if (emulated) {
        emulator_read(&in);
        dl_tick(&machine, at_us, &in, &out);
        emulator_write(&out);
    } else {
        board_read(&in);
        dl_tick(&machine, at_us, &in, &out);
        board_write(&out);
        if (board_has_display) panel_step(&machine);
    }
    watchdog_feed();
}

/* Periods that were missed (an emulator's host is sometimes busy) are made up for, but not without end. */
static void tick_when_due(void)
{
    const uint16_t period_us = board_build.period_us;
    while ((int32_t)(now_us() - next_tick_us) >= 0) {
        const uint32_t late = (now_us() - next_tick_us) / period_us;
        if (late > LATE_PERIODS) next_tick_us += late * period_us;
        tick(next_tick_us);
        next_tick_us += period_us;
    }
}

static void send_when_possible(void)
{
    uint8_t frame[DL_FRAME_MAX];
    while (usart_room() >= DL_FRAME_MAX) {
        const uint8_t count = dl_transmit(&machine, frame);
        if (!count) return;
        usart_write(frame, count);
    }
}

/* Saving stops everything for half a second: the answer to the command leaves before. */
static void save_when_asked(void)
{
    static uint8_t asked;
    asked |= dl_take_save_request(&machine);
    if (!asked || !usart_idle()) return;
    asked = 0;
    store_write(&machine);
}

/* Sleeps until the next interrupt, and counts how long. */
static void rest(void)
{
    static uint32_t window_us, idle_us;
    const uint32_t before = now_us();
    wait_for_interrupt();
    idle_us += now_us() - before;
    const uint32_t passed_us = now_us() - window_us;
    if (passed_us < LOAD_WINDOW_US) return;
    load_percent = idle_us < passed_us ? (uint8_t)(100 - 100 * idle_us / passed_us) : 0;
    window_us += passed_us;
    idle_us = 0;
}

int main(void)
{
    chip_start();
    if (!emulated) {
        board_start();
        if (board_has_display) panel_start();
    }
    usart_start();
    dl_start(&machine, &board_build, reset_cause(), chip_serial(), store_read());
    watchdog_start();
    next_tick_us = now_us();
    for (;;) {
        for (int byte; (byte = usart_read()) >= 0;) dl_receive(&machine, (uint8_t)byte);
        tick_when_due();
        send_when_possible();
        save_when_asked();
        rest();
    }
}
