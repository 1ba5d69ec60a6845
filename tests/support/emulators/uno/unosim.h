/* An Arduino Uno around simavr, one step at a time: for tests only.
 *
 * Links against libsimavr, which is under the GPL version 3; so this library is a test tool and never part of what is
 * shipped. Time moves only in uno_run; times are processor cycles of 1/16 us. Pins are Arduino numbers, 0..19. */
#ifndef UNOSIM_H
#define UNOSIM_H

#include <stdint.h>

typedef struct uno uno;

uno *uno_new(const char *elf); /* NULL if the file is no firmware */
void uno_free(uno *u);
/* 0, or 1 if the processor crashed. */
int uno_run(uno *u, uint32_t us);
/* As the reset button and DTR do; memory stays, the bootloader then lasts `boot_us`. */
void uno_reset(uno *u, uint32_t boot_us);
/* 1: every reset clears MCUSR, as the genuine Uno's bootloader does. */
void uno_bootloader_clears_cause(uno *u, int clears);
uint64_t uno_cycles(const uno *u);
uint64_t uno_cycles_slept(const uno *u);
uint32_t uno_resets(const uno *u); /* by watchdog or line */

/* Serial port: bytes reach the processor at the line's pace. */
void uno_send(uno *u, const uint8_t *bytes, uint32_t count);
uint32_t uno_take(uno *u, uint8_t *bytes, uint32_t room);
uint32_t uno_unsent(const uno *u);

void uno_analog(uno *u, uint8_t channel, uint32_t millivolts);
void uno_drive_pin(uno *u, uint8_t pin, uint8_t level);
uint8_t uno_level(const uno *u, uint8_t pin);
uint32_t uno_rises(const uno *u, uint8_t pin);
uint32_t uno_pulse(const uno *u, uint8_t pin); /* length of the last high pulse */
uint64_t uno_risen(const uno *u, uint8_t pin); /* when it last rose */
uint8_t uno_pwm(const uno *u, uint8_t pin);    /* 0..255, by the timer's registers, else by the level */
/* From now on steps on `pin` count up while `direction` is high, down while it is low. */
void uno_count_steps(uno *u, uint8_t pin, uint8_t direction);
int32_t uno_steps(const uno *u, uint8_t pin);

uint8_t uno_peek(const uno *u, uint16_t address);
void uno_poke(uno *u, uint16_t address, uint8_t value);
void uno_eeprom(uno *u, uint8_t *bytes, uint32_t count, int write);
void uno_jump(uno *u, uint32_t address); /* byte address in flash */

/* Cycle by cycle (slow): where the time goes, by word address, and how long functions last. */
void uno_profile(uno *u, uint32_t *cycles_at);
void uno_watch(uno *u, uint32_t address);
uint32_t uno_longest(const uno *u); /* of a call of the watched function, interrupts included */
uint32_t uno_longest_masked(const uno *u); /* with interrupts off */

#endif
