#include "chip.h"

#include "codes.h"
#include "emulator.h"
#include "figures.h"
#include "stm32f4.h"

enum { PATIENCE = 100000, TICK_HZ = 1000, WATCHDOG_MS = 60, ALL_PORTS_A_TO_E = 0x1F };
enum { WATCHDOG_RUN = 0xCCCC, WATCHDOG_UNLOCK = 0x5555, WATCHDOG_RELOAD = 0xAAAA };

uint8_t emulated;

/* 1 once the bits are set; a crystal that is missing must not keep the board from starting. */
static uint8_t comes(reg *where, uint32_t bits)
{
    for (uint32_t i = 0; i < PATIENCE; i++)
        if ((*where & bits) == bits) return 1;
    return 0;
}

/* 168 MHz from the 8 MHz crystal, or from the internal 16 MHz oscillator (1 %) without one. */
static void clocks_start(void)
{
    RCC->CR |= RCC_HSEON;
    const uint8_t crystal = comes(&RCC->CR, RCC_HSERDY);
    const uint32_t m = crystal ? 8 : 16, n = 336, p_is_2 = 0, q = 7;
    FLASH->ACR = FLASH_5_WAIT_STATES | FLASH_PREFETCH | FLASH_INSTRUCTION_CACHE | FLASH_DATA_CACHE;
    RCC->PLLCFGR = m | n << 6 | p_is_2 << 16 | (crystal ? RCC_PLLSRC_HSE : 0) | q << 24;
    RCC->CFGR = RCC_APB1_BY_4 | RCC_APB2_BY_2;
    RCC->CR |= RCC_PLLON;
    comes(&RCC->CR, RCC_PLLRDY);
    RCC->CFGR |= RCC_SW_PLL;
    comes(&RCC->CFGR, RCC_SWS_PLL);
}

/* TIM5 counts microseconds; SysTick only wakes the main loop, for an emulator loses some of its interrupts. */
static void time_start(void)
{
    TIM5->PSC = timer_prescaler(emulated ? EMULATED_TIMER_HZ : APB1_TIMER_HZ, 1000000);
    TIM5->ARR = 0xFFFFFFFF;
    TIM5->EGR = TIM_UG;
    TIM5->CR1 = TIM_CEN;
    SYSTICK_LOAD = timer_reload(CORE_HZ, TICK_HZ);
    SYSTICK_VALUE = 0;
    SYSTICK_CTRL = 7; /* the processor's clock, with interrupt, on */
}

void chip_start(void)
{
    emulated = RCC->CR == 0;
    if (!emulated) clocks_start();
    RCC->AHB1ENR |= ALL_PORTS_A_TO_E;
    RCC->APB1ENR |= RCC_TIM3 | RCC_TIM4 | RCC_TIM5 | RCC_TIM7 | RCC_USART2;
    RCC->APB2ENR |= RCC_TIM1 | RCC_ADC1;
    time_start();
}

uint32_t now_us(void) { return TIM5->CNT; }

uint8_t reset_cause(void)
{
    if (emulated) return sim.reset;
    const uint32_t flags = RCC->CSR;
    RCC->CSR |= RCC_RMVF;
    if (flags & (RCC_IWDGRSTF | RCC_WWDGRSTF)) return DL_RESET_WATCHDOG; /* which pulls the reset line as well */
    return flags & RCC_PORRSTF ? DL_RESET_POWER : DL_RESET_LINE;
}

uint32_t chip_serial(void)
{
    const volatile uint32_t *id = emulated ? sim.chip_id : CHIP_ID;
    uint32_t hash = 2166136261u; /* FNV-1a */
    for (uint8_t i = 0; i < 12; i++) hash = (hash ^ (id[i / 4] >> 8 * (i % 4) & 0xFF)) * 16777619u;
    hash = (hash >> 24 ^ hash) & 0xFFFFFF;
    return hash ? hash : 1; /* 0 means a board without a number */
}

void watchdog_start(void)
{
    DBG_APB1_FREEZE |= DBG_IWDG;
    IWDG->KR = WATCHDOG_RUN;
    IWDG->KR = WATCHDOG_UNLOCK;
    IWDG->PR = 0; /* the oscillator by 4 */
    IWDG->RLR = watchdog_reload(WATCHDOG_MS);
    IWDG->KR = WATCHDOG_RELOAD;
}

void watchdog_feed(void) { IWDG->KR = WATCHDOG_RELOAD; }
