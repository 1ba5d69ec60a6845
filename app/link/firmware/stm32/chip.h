/* The processor itself: its clocks, its number, why it started, and the watchdog. */
#ifndef CHIP_H
#define CHIP_H

#include <stdint.h>

/* 1 in QEMU, which models no clocks: there they stand still, and the first of their registers reads 0. */
extern uint8_t emulated;

void chip_start(void);
/* Microseconds since the start; wraps after 71 minutes. */
uint32_t now_us(void);
/* One of DL_RESET_...; asked a second time the answer is DL_RESET_LINE. */
uint8_t reset_cause(void);
/* 1 to 16 777 215: a hash of the chip's own number, short enough for a float. */
uint32_t chip_serial(void);

/* From now on `watchdog_feed` must be called every 40 ms, or the processor is reset. */
void watchdog_start(void);
void watchdog_feed(void);

#endif
