/* See unosim.h. GPL version 3 by its library: a test tool, never shipped. */
#include "unosim.h"

#include <simavr/avr_adc.h>
#include <simavr/avr_eeprom.h>
#include <simavr/avr_ioport.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_irq.h>
#include <stdlib.h>
#include <string.h>

enum { PINS = 20, QUEUE = 1 << 16, CYCLES_PER_US = 16 };
enum { MCUSR_ADDRESS = 0x54, EICRA_ADDRESS = 0x69, EXTRF_MASK = 2 };
/* simavr counts a parity bit always: 11 bits of 8.5 us a byte, where the wire needs 10. */
enum { CYCLES_PER_BYTE = 1504, FAR = 1000000 };

typedef struct {
    uno *owner;
    uint8_t level, counts, direction, driven, outside;
    uint32_t rises, pulse;
    int32_t steps;
    uint64_t risen;
} pin_state;

typedef struct {
    uint8_t bytes[QUEUE];
    uint32_t head, tail;
} queue;

struct uno {
    avr_t *avr;
    avr_irq_t *input;
    pin_state pins[PINS];
    queue to_board, from_board;
    uint64_t slept;
    uint32_t resets;
    int clears_cause, fresh, by_line;
    uint32_t *cycles_at;
    uint32_t watched, longest, longest_masked;
    uint16_t watched_stack;
    uint64_t entered, masked_since;
};

static void push(queue *q, uint8_t byte) {
    if (q->head - q->tail < QUEUE) q->bytes[q->head++ % QUEUE] = byte;
}

static void quiet(avr_t *avr, const int level, const char *format, va_list list) {
    (void)avr, (void)level, (void)format, (void)list;
}

/* Time jumps to the next event; without this simavr would sleep in earnest. */
static void sleep_fast(avr_t *avr, avr_cycle_count_t cycles) {
    uno *u = avr->custom.data;
    u->slept += cycles;
}

static avr_cycle_count_t deliver_byte(avr_t *avr, avr_cycle_count_t when, void *parameter) {
    uno *u = parameter;
    (void)avr;
    if (u->to_board.head == u->to_board.tail) return 0;
    avr_raise_irq(u->input, u->to_board.bytes[u->to_board.tail++ % QUEUE]);
    return when + CYCLES_PER_BYTE;
}

static avr_cycle_count_t stop_here(avr_t *avr, avr_cycle_count_t when, void *parameter) {
    (void)avr, (void)when, (void)parameter;
    return 0;
}

static void on_byte(avr_irq_t *irq, uint32_t value, void *parameter) {
    (void)irq;
    push(&((uno *)parameter)->from_board, (uint8_t)value);
}

static void on_pin(avr_irq_t *irq, uint32_t value, void *parameter) {
    pin_state *pin = parameter;
    uno *u = pin->owner;
    (void)irq;
    uint8_t level = value & 1;
    if (level == pin->level) return;
    pin->level = level;
    if (!level) {
        pin->pulse = (uint32_t)(u->avr->cycle - pin->risen);
        return;
    }
    pin->risen = u->avr->cycle;
    ++pin->rises;
    if (pin->counts) pin->steps += u->pins[pin->direction].level ? 1 : -1;
}

/* Arduino's pin: D0-D7 are PD0-PD7, D8-D13 PB0-PB5, D14-D19 (A0-A5) PC0-PC5. */
static char port_of(uint8_t pin, uint8_t *bit) {
    *bit = pin < 8 ? pin : pin < 14 ? pin - 8 : pin - 14;
    return pin < 8 ? 'D' : pin < 14 ? 'B' : 'C';
}

/* What is held from outside. Without the external state a pull-up of the processor would win. */
static void drive_pins(uno *u) {
    for (uint8_t i = 0; i < PINS; ++i) {
        if (!u->pins[i].driven) continue;
        uint8_t bit;
        char port = port_of(i, &bit);
        avr_ioport_external_t external = {.name = port, .mask = 0, .value = 0};
        for (uint8_t k = 0; k < PINS; ++k) {
            uint8_t other;
            if (port_of(k, &other) != port || !u->pins[k].driven) continue;
            external.mask |= 1 << other;
            external.value |= u->pins[k].outside << other;
        }
        avr_ioctl(u->avr, AVR_IOCTL_IOPORT_SET_EXTERNAL(port), &external);
        avr_irq_t *irq = avr_io_getirq(u->avr, AVR_IOCTL_IOPORT_GETIRQ(port), bit);
        avr_raise_irq(irq, !u->pins[i].outside); /* the same level again would be passed over, also after a reset */
        avr_raise_irq(irq, u->pins[i].outside);
    }
}

/* simavr forgets every cycle timer at each reset, also at one by the watchdog. */
static void on_reset(avr_t *avr) {
    uno *u = avr->custom.data;
    u->fresh = 1;
    ++u->resets;
}

/* On a low level, as INT0 and INT1 are built, simavr looks at D2 and D3 in every cycle, used or not: 40 times slower. */
static void calm_interrupt_pins(uno *u) { u->avr->data[EICRA_ADDRESS] = 0x0F; }

static void after_reset(uno *u) {
    calm_interrupt_pins(u);
    drive_pins(u);
    u->fresh = 0;
    u->to_board.tail = u->to_board.head;
    u->entered = u->masked_since = 0;
    if (u->by_line) u->avr->data[MCUSR_ADDRESS] |= EXTRF_MASK;
    if (u->clears_cause) u->avr->data[MCUSR_ADDRESS] = 0;
    u->by_line = 0;
}

static void connect(uno *u) {
    uint32_t flags = 0;
    avr_ioctl(u->avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    u->input = avr_io_getirq(u->avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
    avr_irq_register_notify(avr_io_getirq(u->avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), on_byte, u);
    for (uint8_t i = 0; i < PINS; ++i) {
        uint8_t bit;
        char port = port_of(i, &bit);
        u->pins[i].owner = u;
        avr_irq_register_notify(avr_io_getirq(u->avr, AVR_IOCTL_IOPORT_GETIRQ(port), bit), on_pin, &u->pins[i]);
    }
}

uno *uno_new(const char *elf) {
    elf_firmware_t firmware = {0};
    avr_global_logger_set(quiet);
    if (elf_read_firmware(elf, &firmware)) return NULL;
    uno *u = calloc(1, sizeof *u);
    u->avr = avr_make_mcu_by_name("atmega328p");
    avr_init(u->avr);
    avr_load_firmware(u->avr, &firmware);
    u->avr->frequency = 16000000;
    u->avr->vcc = u->avr->avcc = u->avr->aref = 5000;
    u->avr->custom.data = u;
    u->avr->sleep = sleep_fast;
    u->avr->reset = on_reset;
    u->avr->run_cycle_limit = FAR; /* as built it is 1, which makes sleep a step-by-step affair */
    u->avr->data[MCUSR_ADDRESS] = 1; /* power on */
    calm_interrupt_pins(u);
    connect(u);
    return u;
}

void uno_free(uno *u) {
    avr_terminate(u->avr);
    free(u->avr);
    free(u);
}

static void profile(uno *u, uint32_t pc, uint64_t before) {
    avr_t *avr = u->avr;
    uint16_t stack = avr->data[R_SPL] | avr->data[R_SPH] << 8;
    if (avr->state != cpu_Sleeping) u->cycles_at[pc / 2] += (uint32_t)(avr->cycle - before);
    if (u->watched && !u->entered && avr->pc == u->watched) {
        u->entered = avr->cycle;
        u->watched_stack = stack;
    } else if (u->entered && stack > u->watched_stack) {
        if (avr->cycle - u->entered > u->longest) u->longest = (uint32_t)(avr->cycle - u->entered);
        u->entered = 0;
    }
    if (avr->sreg[S_I]) u->masked_since = 0;
    else if (!u->masked_since) u->masked_since = avr->cycle;
    else if (avr->cycle - u->masked_since > u->longest_masked) {
        u->longest_masked = (uint32_t)(avr->cycle - u->masked_since);
    }
}

int uno_run(uno *u, uint32_t us) {
    avr_t *avr = u->avr;
    uint64_t end = avr->cycle + (uint64_t)us * CYCLES_PER_US;
    avr_cycle_timer_register(avr, end - avr->cycle, stop_here, u);
    while (avr->cycle < end) {
        uint64_t before = avr->cycle;
        uint32_t pc = avr->pc;
        int state = avr_run(avr);
        if (state == cpu_Done || state == cpu_Crashed) return 1;
        if (u->cycles_at) profile(u, pc, before);
        if (u->fresh) {
            after_reset(u);
            if (avr->cycle < end) avr_cycle_timer_register(avr, end - avr->cycle, stop_here, u);
        }
    }
    return 0;
}

void uno_reset(uno *u, uint32_t boot_us) {
    u->by_line = 1;
    avr_reset(u->avr);
    after_reset(u);
    u->avr->cycle += (uint64_t)boot_us * CYCLES_PER_US;
}

void uno_bootloader_clears_cause(uno *u, int clears) { u->clears_cause = clears; }
uint64_t uno_cycles(const uno *u) { return u->avr->cycle; }
uint64_t uno_cycles_slept(const uno *u) { return u->slept; }
uint32_t uno_resets(const uno *u) { return u->resets; }

void uno_send(uno *u, const uint8_t *bytes, uint32_t count) {
    for (uint32_t i = 0; i < count; ++i) push(&u->to_board, bytes[i]);
    if (!avr_cycle_timer_status(u->avr, deliver_byte, u)) {
        avr_cycle_timer_register(u->avr, CYCLES_PER_BYTE, deliver_byte, u);
    }
}

uint32_t uno_unsent(const uno *u) { return u->to_board.head - u->to_board.tail; }

uint32_t uno_take(uno *u, uint8_t *bytes, uint32_t room) {
    uint32_t count = 0;
    queue *q = &u->from_board;
    while (q->head != q->tail && count < room) bytes[count++] = q->bytes[q->tail++ % QUEUE];
    return count;
}

void uno_analog(uno *u, uint8_t channel, uint32_t millivolts) {
    avr_raise_irq(avr_io_getirq(u->avr, AVR_IOCTL_ADC_GETIRQ, ADC_IRQ_ADC0 + channel), millivolts);
}

void uno_drive_pin(uno *u, uint8_t pin, uint8_t level) {
    u->pins[pin].driven = 1;
    u->pins[pin].outside = level;
    drive_pins(u);
}

uint8_t uno_level(const uno *u, uint8_t pin) { return u->pins[pin].level; }
uint32_t uno_rises(const uno *u, uint8_t pin) { return u->pins[pin].rises; }
uint32_t uno_pulse(const uno *u, uint8_t pin) { return u->pins[pin].pulse; }
uint64_t uno_risen(const uno *u, uint8_t pin) { return u->pins[pin].risen; }

uint8_t uno_pwm(const uno *u, uint8_t pin) {
    enum { TCCR0A = 0x44, OCR0A = 0x47, OCR0B = 0x48, TCCR2A = 0xB0, OCR2A = 0xB3, OCR2B = 0xB4 };
    const uint8_t *data = u->avr->data;
    if (pin == 3 && data[TCCR2A] & 0x20) return data[OCR2B];
    if (pin == 5 && data[TCCR0A] & 0x20) return data[OCR0B];
    if (pin == 6 && data[TCCR0A] & 0x80) return data[OCR0A];
    if (pin == 11 && data[TCCR2A] & 0x80) return data[OCR2A];
    return u->pins[pin].level ? 255 : 0;
}

void uno_count_steps(uno *u, uint8_t pin, uint8_t direction) {
    u->pins[pin].counts = 1;
    u->pins[pin].direction = direction;
}

int32_t uno_steps(const uno *u, uint8_t pin) { return u->pins[pin].steps; }

uint8_t uno_peek(const uno *u, uint16_t address) { return u->avr->data[address]; }
void uno_poke(uno *u, uint16_t address, uint8_t value) { u->avr->data[address] = value; }

void uno_eeprom(uno *u, uint8_t *bytes, uint32_t count, int write) {
    avr_eeprom_desc_t description = {.ee = bytes, .offset = 0, .size = count};
    avr_ioctl(u->avr, write ? AVR_IOCTL_EEPROM_SET : AVR_IOCTL_EEPROM_GET, &description);
}

void uno_jump(uno *u, uint32_t address) { u->avr->pc = address; }

void uno_profile(uno *u, uint32_t *cycles_at) {
    u->cycles_at = cycles_at;
    u->avr->run_cycle_limit = cycles_at ? 1 : FAR;
}

void uno_watch(uno *u, uint32_t address) {
    u->watched = address;
    u->longest = u->longest_masked = 0;
}

uint32_t uno_longest(const uno *u) { return u->longest; }
uint32_t uno_longest_masked(const uno *u) { return u->longest_masked; }
