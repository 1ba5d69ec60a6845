/* From reset to main: the vectors, and the memory as C expects it. */
#include <stdint.h>

#include "board.h"
#include "chip.h"
#include "steppers.h"
#include "stm32f4.h"
#include "usart.h"

int main(void);
extern uint32_t stack_top, data_image, data_begin, data_end, bss_begin, bss_end;

enum { CORE_VECTORS = 16, VECTORS = CORE_VECTORS + IRQ_TIM7 + 1 };
typedef void (*vector)(void);
static const vector vectors[VECTORS];

void Reset_Handler(void)
{
    SCB_VTOR = (uint32_t)vectors; /* a boot loader may have had its own */
    SCB_CPACR |= 0xFu << 20; /* the floating-point unit */
    __asm volatile("dsb\n isb");
    for (uint32_t *from = &data_image, *to = &data_begin; to < &data_end;) *to++ = *from++;
    for (uint32_t *to = &bss_begin; to < &bss_end;) *to++ = 0;
    main();
}

/* An access that the processor refuses. Nothing feeds the watchdog any more: it resets the board, which then says so.
 */
void Fault_Handler(void)
{
    if (!emulated) board_off();
    for (;;) {
    }
}

static void SysTick_Handler(void) {} /* ends the main loop's waiting */

__attribute__((section(".vectors"), used)) static const vector vectors[VECTORS] = {
    (vector)&stack_top, Reset_Handler,
    [2 ... 14] = Fault_Handler,
    [15] = SysTick_Handler,
    [16 ... 15 + IRQ_USART2] = Fault_Handler,
    [16 + IRQ_USART2] = USART2_IRQHandler,
    [17 + IRQ_USART2 ... 15 + IRQ_TIM7] = Fault_Handler,
    [16 + IRQ_TIM7] = TIM7_IRQHandler,
};
