/* The registers of the STM32F407 that this firmware uses: addresses and layouts of ST's reference manual RM0090.
 *
 * With DL_HOST_REGISTERS the peripherals are an array in memory: tests on a desktop compile the drivers so, run them,
 * and look at what they have written at the manual's addresses.
 */
#ifndef STM32F4_H
#define STM32F4_H

#include <stdint.h>

#ifdef DL_HOST_REGISTERS
extern uint8_t host_registers[1 << 20]; /* no two of the registers below agree in their last 20 bits */
#define AT(address) (host_registers + ((address) & 0xFFFFF))
static inline void interrupts_off(void) {}
static inline void interrupts_on(void) {}
void host_reacts(void); /* what the peripherals do about a write */
#else
#define AT(address) (address)
static inline void interrupts_off(void) { __asm volatile("cpsid i" ::: "memory"); }
static inline void interrupts_on(void) { __asm volatile("cpsie i" ::: "memory"); }
static inline void wait_for_interrupt(void) { __asm volatile("wfi" ::: "memory"); }
static inline void host_reacts(void) {}
#endif

typedef volatile uint32_t reg;

typedef struct {
    reg MODER, OTYPER, OSPEEDR, PUPDR, IDR, ODR, BSRR, LCKR, AFR[2];
} gpio_registers;
#define GPIO(port) ((gpio_registers *)AT(0x40020000u + 0x400u * (port))) /* port 0 is A */

typedef struct {
    reg CR1, CR2, SMCR, DIER, SR, EGR, CCMR[2], CCER, CNT, PSC, ARR, RCR, CCR[4], BDTR;
} timer_registers;
#define TIM1 ((timer_registers *)AT(0x40010000u))
#define TIM3 ((timer_registers *)AT(0x40000400u))
#define TIM4 ((timer_registers *)AT(0x40000800u))
#define TIM5 ((timer_registers *)AT(0x40000C00u))
#define TIM7 ((timer_registers *)AT(0x40001400u))
enum { TIM_CEN = 1, TIM_ARPE = 1 << 7, TIM_UIE = 1, TIM_UIF = 1, TIM_UG = 1 };
enum { TIM_PWM_MODE_1 = 6 << 4, TIM_PRELOAD = 1 << 3 };                 /* of an output channel, in CCMR */
enum { TIM_OSSI = 1 << 10, TIM_OSSR = 1 << 11, TIM_BKE = 1 << 12, TIM_BKP = 1 << 13, TIM_MOE = 1 << 15 };

typedef struct {
    reg SR, DR, BRR, CR1, CR2, CR3, GTPR;
} usart_registers;
#define USART2 ((usart_registers *)AT(0x40004400u))
enum { USART_ORE = 1 << 3, USART_RXNE = 1 << 5, USART_TXE = 1 << 7 };
enum { USART_RE = 1 << 2, USART_TE = 1 << 3, USART_RXNEIE = 1 << 5, USART_TXEIE = 1 << 7, USART_UE = 1 << 13 };

typedef struct {
    reg SR, CR1, CR2, SMPR1, SMPR2, JOFR[4], HTR, LTR, SQR[3], JSQR, JDR[4], DR;
} adc_registers;
#define ADC1 ((adc_registers *)AT(0x40012000u))
#define ADC_CCR (*(reg *)AT(0x40012304u))
enum { ADC_JEOC = 1 << 2, ADC_SCAN = 1 << 8, ADC_ADON = 1, ADC_JSWSTART = 1 << 22, ADC_PCLK2_BY_4 = 1 << 16 };

typedef struct {
    reg CR, PLLCFGR, CFGR, CIR, AHB1RSTR, AHB2RSTR, AHB3RSTR, reserved0, APB1RSTR, APB2RSTR, reserved1[2], AHB1ENR,
        AHB2ENR, AHB3ENR, reserved2, APB1ENR, APB2ENR, reserved3[2], AHB1LPENR, AHB2LPENR, AHB3LPENR, reserved4,
        APB1LPENR, APB2LPENR, reserved5[2], BDCR, CSR;
} rcc_registers;
#define RCC ((rcc_registers *)AT(0x40023800u))
enum { RCC_HSEON = 1 << 16, RCC_HSERDY = 1 << 17, RCC_PLLON = 1 << 24, RCC_PLLRDY = 1 << 25 };
enum { RCC_PLLSRC_HSE = 1 << 22 };
enum { RCC_SW_PLL = 2, RCC_SWS_PLL = 2 << 2, RCC_APB1_BY_4 = 5 << 10, RCC_APB2_BY_2 = 4 << 13 };
enum { RCC_TIM3 = 1 << 1, RCC_TIM4 = 1 << 2, RCC_TIM5 = 1 << 3, RCC_TIM7 = 1 << 5, RCC_USART2 = 1 << 17 }; /* APB1ENR */
enum { RCC_TIM1 = 1, RCC_ADC1 = 1 << 8 };                                                                 /* APB2ENR */
enum { RCC_RMVF = 1 << 24, RCC_PORRSTF = 1 << 27, RCC_IWDGRSTF = 1 << 29, RCC_WWDGRSTF = 1 << 30 };       /* CSR */

typedef struct {
    reg ACR, KEYR, OPTKEYR, SR, CR;
} flash_registers;
#define FLASH ((flash_registers *)AT(0x40023C00u))
enum { FLASH_5_WAIT_STATES = 5, FLASH_PREFETCH = 1 << 8, FLASH_INSTRUCTION_CACHE = 1 << 9, FLASH_DATA_CACHE = 1 << 10 };
enum { FLASH_PG = 1, FLASH_SER = 1 << 1, FLASH_SECTOR = 3, FLASH_PSIZE_32 = 2 << 8, FLASH_STRT = 1 << 16 };
#define FLASH_ERRORS 0xF2u /* cleared by writing them */
#define FLASH_BUSY (1u << 16)
#define FLASH_LOCK (1u << 31)

typedef struct {
    reg KR, PR, RLR, SR;
} watchdog_registers;
#define IWDG ((watchdog_registers *)AT(0x40003000u))

#define SYSTICK_CTRL (*(reg *)AT(0xE000E010u))
#define SYSTICK_LOAD (*(reg *)AT(0xE000E014u))
#define SYSTICK_VALUE (*(reg *)AT(0xE000E018u))
#define NVIC_ENABLE(irq) (((reg *)AT(0xE000E100u))[(irq) / 32] = 1u << (irq) % 32)
#define NVIC_PEND(irq) (((reg *)AT(0xE000E200u))[(irq) / 32] = 1u << (irq) % 32)
#define SCB_VTOR (*(reg *)AT(0xE000ED08u))
#define SCB_CPACR (*(reg *)AT(0xE000ED88u))
#define DBG_APB1_FREEZE (*(reg *)AT(0xE0042008u)) /* stops the watchdog while a debugger holds the processor */
enum { DBG_IWDG = 1 << 12 };
enum { IRQ_USART2 = 38, IRQ_TIM7 = 55 };

#define CHIP_ID ((const uint32_t *)AT(0x1FFF7A10u)) /* 96 bits, different in every chip */

#endif
