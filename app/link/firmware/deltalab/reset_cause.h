/* Why the processor was reset, also where the Uno's bootloader has cleared the register that tells.
 *
 * Optiboot 4.4 of every genuine Uno clears MCUSR. So a mark in memory that resets leave alone says how far we were:
 * ticks.h writes MARK_HUNG when ticks are no longer taken, shortly before the hardware watchdog strikes. */
#ifndef DL_RESET_CAUSE_H
#define DL_RESET_CAUSE_H

#include <avr/io.h>
#include <avr/wdt.h>

enum { MARK_RUNNING = 0x52D7, MARK_HUNG = 0xB8A1 };

static uint8_t reset_flags __attribute__((section(".noinit")));
static volatile uint16_t reset_mark __attribute__((section(".noinit")));

/* Before anything else: a watchdog that has struck stays on, with its shortest time, until this is done. */
extern "C" void calm_watchdog(void) __attribute__((naked, used, section(".init3")));
extern "C" void calm_watchdog(void) {
    reset_flags = MCUSR;
    MCUSR = 0;
    wdt_disable();
}

static uint8_t reset_cause() {
    bool external = reset_flags & _BV(EXTRF); /* newer bootloaders leave both flags after a press of reset */
    bool hung = (reset_flags & _BV(WDRF) && !external) || reset_mark == MARK_HUNG;
    bool ran = reset_mark == MARK_RUNNING && !(reset_flags & _BV(PORF));
    reset_mark = MARK_RUNNING;
    return hung ? DL_RESET_WATCHDOG : (external || ran) ? DL_RESET_LINE : DL_RESET_POWER;
}

#endif
