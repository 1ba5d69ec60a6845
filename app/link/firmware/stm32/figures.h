/* Register values from what is wanted, by the formulas of the reference manual RM0090. */
#ifndef FIGURES_H
#define FIGURES_H

#include <stdint.h>

#define CORE_HZ 168000000u
#define APB1_HZ 42000000u       /* USART2 */
#define APB1_TIMER_HZ 84000000u /* TIM3, 4, 5, 7: twice the bus where its divider is not 1 */
#define APB2_TIMER_HZ 168000000u /* TIM1 */
#define EMULATED_TIMER_HZ 1000000000u /* what QEMU's timers count */
#define WATCHDOG_HZ 32000u      /* the internal RC oscillator: 17 to 47 kHz from chip to chip */

/* BRR, sixteen-fold oversampling: sixteenths of clock / (16 baud), rounded. */
static inline uint32_t usart_divider(uint32_t clock_hz, uint32_t baud) { return (clock_hz + baud / 2) / baud; }

/* PSC for a counter that runs at `count_hz`, and ARR for `count_hz / hz` counts: both registers count from 0. */
static inline uint32_t timer_prescaler(uint32_t clock_hz, uint32_t count_hz) { return clock_hz / count_hz - 1; }
static inline uint32_t timer_reload(uint32_t count_hz, uint32_t hz) { return count_hz / hz - 1; }

/* RLR at the smallest prescaler, 4. */
static inline uint32_t watchdog_reload(uint32_t milliseconds) { return WATCHDOG_HZ / 4 * milliseconds / 1000 - 1; }

/* CCR for a share of the period; a full one never goes low. */
static inline uint32_t compare_for(float share, uint32_t reload)
{
    if (!(share > 0.0f)) return 0; /* also what is not a number */
    return share < 1.0f ? (uint32_t)(share * (float)(reload + 1) + 0.5f) : reload + 1;
}

#endif
